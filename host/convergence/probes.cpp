#include "convergence/probes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>

#include "convergence/relative_variance.h"

namespace facet {

namespace {

constexpr std::size_t least_probes = 64;  ///< of a stratum

std::size_t pixels_of(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

/// Side of the squares with one probe each: as large as leaves a thousand of them, from 2 to 8;
/// where that would leave too few of them, every pixel is probed.
int probe_spacing(int width, int height) {
  const std::size_t pixels = pixels_of(width, height);
  if (pixels < 8 * least_probes) return 1;
  int side = 2;
  while (side < 8 && pixels / static_cast<std::size_t>(4 * side * side) >= 1024) side *= 2;
  return side;
}

/// Two estimates of a pixel's relative variance: by the variance of the samples of both of its
/// means, and by the difference between these. In both the means count alike: what one has happened
/// to see does not decide.
struct Pair {
  double by_samples = 0;
  double by_difference = 0;

  Pair(const PixelSums& pixel, const PixelSums& probe, double epsilon) {
    const Color3 a = pixel.mean();
    const Color3 b = probe.mean();
    const Color3 of_probe = variance_by_samples(probe);
    Color3 variance = variance_by_samples(pixel);
    Color3 difference{};
    Color3 mean{};
    const double m = pixel.samples;
    const double n = probe.samples;
    for (std::size_t c = 0; c < 3; ++c) {
      mean[c] = (a[c] * m + b[c] * n) / (m + n);
      // Both as of a mean of m samples.
      difference[c] = (a[c] - b[c]) * (a[c] - b[c]) * n / (m + n);
      variance[c] = (variance[c] + of_probe[c] * n / m) / 2;
    }
    by_samples = relative_variance(variance, mean, epsilon);
    by_difference = relative_variance(difference, mean, epsilon);
  }
};

/// Strata reach over factors of four: narrow ones would sort pixels that are alike by what they
/// happen to have seen.
double factor_of_four(double relative_variance) {
  return std::floor(std::log2(relative_variance) / 2);
}

/// A ratio estimator (W. G. Cochran, "Sampling Techniques", 1977, chapter 6).
OrderGains::Stratum stratum_of_pairs(std::span<const Pair> pairs) {
  OrderGains::Stratum stratum{pairs.back().by_samples};
  double below = 0;
  double above = 0;
  for (const Pair& p : pairs) {
    below += p.by_samples;
    above += p.by_difference;
  }
  if (!(below > 0)) return stratum;
  stratum.ratio = above / below;
  double deviations = 0;
  for (const Pair& p : pairs)
    deviations += std::pow(p.by_difference - stratum.ratio * p.by_samples, 2);
  const auto n = static_cast<double>(pairs.size());
  stratum.variance = deviations * n / (n - 1) / (below * below);
  return stratum;
}

}  // namespace

bool has_probes(int width, int height) { return pixels_of(width, height) >= least_probes; }

std::vector<std::uint32_t> choose_probes(int width, int height, std::uint32_t seed) {
  std::vector<std::uint32_t> probes;
  const int side = probe_spacing(width, height);
  std::mt19937 random(seed);
  for (int y = 0; y < height; y += side) {
    for (int x = 0; x < width; x += side) {
      const auto place = static_cast<int>(random() % static_cast<unsigned>(side * side));
      const int px = x + place % side;
      const int py = y + place / side;
      // Every pixel is chosen as likely, also where the squares are cut off.
      if (px < width && py < height)
        probes.push_back(static_cast<std::uint32_t>(py) * static_cast<std::uint32_t>(width) +
                         static_cast<std::uint32_t>(px));
    }
  }
  std::sort(probes.begin(), probes.end());
  return probes;
}

OrderGains::OrderGains(const Film& film, double epsilon) {
  std::vector<Pair> pairs;
  for (const Probe& probe : film.probes)
    pairs.emplace_back(film.pixels[probe.pixel], probe.sums, epsilon);
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.by_samples < b.by_samples; });
  std::size_t begin = 0;
  for (std::size_t end = 1; end <= pairs.size(); ++end) {
    const bool rest_is_small = pairs.size() - end < least_probes;
    const bool ends = end == pairs.size() || (end - begin >= least_probes && !rest_is_small &&
                                              factor_of_four(pairs[end - 1].by_samples) <
                                                  factor_of_four(pairs[end].by_samples));
    if (!ends || end - begin < least_probes) continue;
    strata_.push_back(stratum_of_pairs(std::span(pairs).subspan(begin, end - begin)));
    begin = end;
  }
  known_ = !strata_.empty();
  if (!known_) strata_.emplace_back();
  strata_.back().largest = std::numeric_limits<double>::infinity();
}

std::size_t OrderGains::stratum_of(double relative_variance) const {
  const auto found = std::lower_bound(strata_.begin(), strata_.end() - 1, relative_variance,
                                      [](const Stratum& s, double v) { return s.largest < v; });
  return static_cast<std::size_t>(found - strata_.begin());
}

}  // namespace facet
