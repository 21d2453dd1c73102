#include "parity/parity.h"

#include <atomic>
#include <mutex>
#include <tuple>

#include "core/parallel.h"
#include "parity/suspects.h"
#include "reference/crop.h"
#include "reference/tracer.h"
#include "statistics/hypothesis.h"

namespace facet::parity {

using reference::blank_film;
using reference::BranchHash;
using reference::CropSample;
using reference::is_good;
using reference::largest_component;
using reference::Tracer;
using reference::ulp;
using statistics::two_sided_normal_quantile;

namespace {

constexpr std::size_t pixels_at_a_time = 64;
constexpr int block_side = 16;
/// Unexplained samples after which further ones are not searched for turned decisions.
constexpr int searched_faults = 200;
/// A sample that agrees only by a tolerance larger than this share of itself says nothing.
constexpr double untestable_spread = 0.1;
constexpr double block_significance = 0.01;

float largest_difference(const Vec3<float>& a, const Vec3<float>& b) {
  return largest_component(a - b);
}

bool equal_bits(const Vec3<float>& a, const Vec3<float>& b) {
  return glm::floatBitsToUint(a) == glm::floatBitsToUint(b);
}

/// One sample of every pixel, in all three renderings.
class Comparison {
 public:
  Comparison(const Scene& scene, const RenderSettings& settings, const Tolerance& tolerance)
      : settings_(settings),
        float_world_(scene, settings),
        double_world_(scene, settings),
        float_film_(blank_film(settings)),
        double_film_(float_film_),
        kernel_film_(float_film_) {
    report_.tolerance = tolerance;
    report_.pixels = float_film_.pixels.size();
  }

  void compare(std::uint32_t sample, const std::vector<Radiance>& kernels) {
    parallel_for(kernels.size(), pixels_at_a_time, [&](std::size_t begin, std::size_t end) {
      Share share;
      for (std::size_t i = begin; i < end; ++i)
        compare_pixel(i, sample, {kernels[i][0], kernels[i][1], kernels[i][2]}, share);
      const std::scoped_lock lock(mutex_);
      gather(share);
    });
  }

  ParityReport finish(const Film& kernel_film) {
    ParityReport& r = report_;
    r.suspects = spectrum_.suspects(float_world_.scene);
    if (!differences_.empty()) {
      const auto rank = differences_.begin() +
                        static_cast<std::ptrdiff_t>((differences_.size() - 1) * 999 / 1000);
      std::nth_element(differences_.begin(), rank, differences_.end());
      r.percentile_difference = static_cast<double>(*rank);
    }
    std::sort(r.diverged.begin(), r.diverged.end(),
              [](const DivergedSample& a, const DivergedSample& b) {
                return std::tie(a.sample, a.y, a.x) < std::tie(b.sample, b.y, b.x);
              });
    compare_films(kernel_film);
    compare_precisions();
    return std::move(report_);
  }

 private:
  /// What one thread finds; the totals live in the report.
  struct Share {
    ParityReport counts;
    std::vector<float> differences;
    double squared_difference = 0;
    Spectrum spectrum;
  };

  void compare_pixel(std::size_t i, std::uint32_t sample, const Vec3<float>& g, Share& share) {
    const CropSample at(settings_, i, sample);
    BranchHash f_branches;
    BranchHash d_branches;
    const Vec3<float> f =
        Tracer<float, BranchHash>(float_world_, at.id, f_branches).radiance(at.x, at.y);
    const Vec3<double> d =
        Tracer<double, BranchHash>(double_world_, at.id, d_branches).radiance(at.x, at.y);
    const float weight = float_world_.camera.filter_sample(at.id).weight;
    add_to(float_film_.pixels[i], f, weight);
    add_to(kernel_film_.pixels[i], g, weight);
    add_to(double_film_.pixels[i], d, double_world_.camera.filter_sample(at.id).weight);

    ParityReport& counts = share.counts;
    ++counts.samples;
    counts.bad_kernel_samples += is_good(g) ? 0 : 1;
    counts.bad_reference_samples += is_good(f) ? 0 : 1;
    if (f_branches.hash == d_branches.hash) {
      ++counts.same_branches;
      const Vec3<double> difference = Vec3<double>(f) - d;
      share.squared_difference += glm::dot(difference, difference);
      counts.largest_precision = std::max(counts.largest_precision, largest_component(difference));
    }
    compare_sample(at, g, f, f_branches, share);
  }

  void compare_sample(const CropSample& at, const Vec3<float>& g, const Vec3<float>& f,
                      const BranchHash& branches, Share& share) {
    ParityReport& counts = share.counts;
    if (equal_bits(g, f)) ++counts.identical;
    const float size = std::max(largest_component(f), largest_component(g));
    const float difference = g == f ? 0 : largest_difference(g, f) / std::max(size, ulp(0.0F));
    share.differences.push_back(difference);
    bool explained = true;
    if (agrees(g, f, Vec3<double>(0), report_.tolerance.relative)) {
      counts.largest_difference =
          std::max(counts.largest_difference, static_cast<double>(difference));
    } else {
      // Where a fault is plain, the search for turned decisions would take long and tell nothing
      // new.
      const bool turn = unexplained_ < searched_faults;
      const Explanation e = explain(float_world_, at.x, at.y, at.id, g, report_.tolerance, turn);
      explained = e.explained();
      if (!explained) ++unexplained_;
      if (e.agrees) {
        ++counts.ill_conditioned;
        if (report_.tolerance.spread_factor * largest_component(e.spread) >
            untestable_spread * static_cast<double>(size))
          ++counts.untestable;
        counts.largest_difference =
            std::max(counts.largest_difference, static_cast<double>(difference));
      } else {
        DivergedSample diverged{at.x, at.y, at.id.index, g, f, e.turned, {}, {}};
        if (e.nearest) diverged.nearest = describe(float_world_, *e.nearest);
        for (const TurnedDecision& t : e.turned)
          diverged.reasons.push_back(describe(float_world_, t));
        counts.diverged.push_back(std::move(diverged));
      }
    }
    share.spectrum.add(branches.features, !explained);
  }

  template <typename Real>
  static void add_to(PixelSums& pixel, const Vec3<Real>& radiance, Real weight) {
    const Vec3<double> value = Vec3<double>(radiance) * static_cast<double>(weight);
    if (std::isfinite(value.x + value.y + value.z)) pixel.add({value.x, value.y, value.z});
  }

  void gather(const Share& share) {
    const ParityReport& s = share.counts;
    ParityReport& r = report_;
    r.samples += s.samples;
    r.identical += s.identical;
    r.ill_conditioned += s.ill_conditioned;
    r.untestable += s.untestable;
    r.largest_difference = std::max(r.largest_difference, s.largest_difference);
    r.diverged.insert(r.diverged.end(), s.diverged.begin(), s.diverged.end());
    r.bad_kernel_samples += s.bad_kernel_samples;
    r.bad_reference_samples += s.bad_reference_samples;
    r.same_branches += s.same_branches;
    r.largest_precision = std::max(r.largest_precision, s.largest_precision);
    r.precision_rms += share.squared_difference;
    differences_.insert(differences_.end(), share.differences.begin(), share.differences.end());
    spectrum_.merge(share.spectrum);
  }

  /// The kernels' film against their own samples, added up here under the reference's filter.
  void compare_films(const Film& film) {
    double largest_square = 0;
    for (const PixelSums& p : kernel_film_.pixels)
      largest_square = std::max({largest_square, p.squares[0], p.squares[1], p.squares[2]});
    const Image g = develop(film, false);
    const Image f = develop(float_film_, false);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      const PixelSums& own = kernel_film_.pixels[i];
      const PixelSums& kernels = film.pixels[i];
      const auto x = static_cast<int>(i % static_cast<std::size_t>(film.width));
      const auto y = static_cast<int>(i / static_cast<std::size_t>(film.width));
      bool identical = true;
      for (int c = 0; c < 3; ++c) {
        const auto k = static_cast<std::size_t>(c);
        // Filters with negative lobes cancel: the size of what was added is the square's root.
        const double size =
            std::sqrt(own.squares[k] * std::max(1.0, static_cast<double>(own.samples)));
        const double difference = std::abs(own.values[k] - kernels.values[k]);
        if (difference > 0)
          report_.film_difference = std::max(
              report_.film_difference, difference / std::max(size, static_cast<double>(ulp(0.0F))));
        identical = identical && g.at(x, y, c) == f.at(x, y, c);
        // Squares of values far below the image's largest underflow in the kernels' floats.
        if (film.has_squares && own.squares[k] > 1e-20 * largest_square)
          report_.film_difference =
              std::max(report_.film_difference, std::abs(kernels.squares[k] / own.squares[k] - 1));
      }
      if (own.samples != kernels.samples) ++report_.miscounted_pixels;
      if (identical) ++report_.identical_pixels;
    }
  }

  void compare_precisions() {
    ParityReport& r = report_;
    const std::uint32_t samples_per_pixel = settings_.samples_per_pixel();
    if (r.same_branches > 0)
      r.precision_rms = std::sqrt(r.precision_rms / (3 * static_cast<double>(r.same_branches)));
    double variance = 0;
    double squares = 0;
    for (const PixelSums& p : float_film_.pixels) {
      const double n = p.samples;
      for (std::size_t c = 0; c < 3; ++c) {
        variance += n * variance_of_mean(p.values[c], p.squares[c], n);
        squares += p.squares[c] / std::max(n, 1.0);
      }
    }
    const double values = 3 * static_cast<double>(r.pixels);
    r.noise_known = samples_per_pixel > 1;
    r.noise_1024 = std::sqrt(variance / values / 1024);
    r.image_rms = std::sqrt(squares / values);
    const int across = (float_film_.width + block_side - 1) / block_side;
    const int down = (float_film_.height + block_side - 1) / block_side;
    const auto tests = static_cast<std::uint64_t>(3) * static_cast<std::uint64_t>(across * down);
    r.critical_z =
        two_sided_normal_quantile(statistics::sidak_significance(block_significance, tests));
    for (int block = 0; block < across * down; ++block)
      r.block_z =
          std::max(r.block_z, largest_z(block % across * block_side, block / across * block_side));
  }

  /// z of the means of F and D over the block at (x0, y0), the largest of the channels.
  [[nodiscard]] double largest_z(int x0, int y0) const {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      double difference = 0;
      double size = 0;
      double variance = 0;
      for (int y = y0; y < std::min(y0 + block_side, float_film_.height); ++y) {
        for (int x = x0; x < std::min(x0 + block_side, float_film_.width); ++x) {
          const auto i = static_cast<std::size_t>(y * float_film_.width + x);
          for (const PixelSums* p : {&float_film_.pixels[i], &double_film_.pixels[i]}) {
            const double n = std::max(p->samples, 1U);
            difference += (p == &float_film_.pixels[i] ? 1 : -1) * p->values[c] / n;
            variance += variance_of_mean(p->values[c], p->squares[c], n);
            size += std::abs(p->values[c]) / n;
          }
        }
      }
      // Without noise the two still differ by float's rounding of every sample.
      const double deviation = std::sqrt(variance) + 1e-6 * size;
      if (difference != 0) largest = std::max(largest, std::abs(difference) / deviation);
    }
    return largest;
  }

  const RenderSettings& settings_;
  World<float> float_world_;
  World<double> double_world_;
  Film float_film_;
  Film double_film_;
  Film kernel_film_;
  std::mutex mutex_;
  std::atomic<int> unexplained_{0};
  ParityReport report_;
  std::vector<float> differences_;
  Spectrum spectrum_;
};

}  // namespace

ParityReport check_parity(const Scene& scene, const RenderSettings& settings,
                          const Tolerance& tolerance, Rendering& kernels,
                          const ParityProgress& progress) {
  Comparison comparison(scene, settings, tolerance);
  const double total = settings.samples_per_pixel();
  for (std::uint32_t sample = settings.samples.begin; sample < settings.samples.end; ++sample) {
    comparison.compare(sample, kernels.sample(sample));
    if (!progress((sample - settings.samples.begin + 1) / total)) break;
  }
  return comparison.finish(kernels.film());
}

}  // namespace facet::parity
