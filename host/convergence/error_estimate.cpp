#include "convergence/error_estimate.h"

#include <algorithm>
#include <cmath>

#include "convergence/probes.h"
#include "convergence/similar_pixels.h"
#include "core/parallel.h"
#include "statistics/hypothesis.h"

namespace facet {

namespace {

/// Terms of a sum over pixels.
struct Terms {
  double sum = 0;
  /// Twice the squares of the terms of the error, each as uncertain as the square of a normal
  /// variable, and once those of their estimates, at worst as uncertain as what a single sample has
  /// seen.
  double variance = 0;

  /// weight: the term stands for so many.
  void add(double term, double weight) {
    sum += weight * term;
    variance += (2 * weight + weight * weight) * term * term;
  }
};

/// The relative error of every pixel, by strata of pixels that gain alike by the order of samples.
class Errors {
 public:
  explicit Errors(const Film& film)
      : film_(film),
        epsilon_(relmse_epsilon(film)),
        gains_(film, epsilon_),
        terms_(gains_.strata().size()) {
    add_known();
    add_unknown();
  }

  [[nodiscard]] ErrorEstimate estimate() const {
    double sum = 0;
    double variance = 0;
    for (std::size_t k = 0; k < terms_.size(); ++k) {
      const OrderGains::Stratum& s = gains_.strata()[k];
      sum += s.ratio * terms_[k].sum;
      variance +=
          s.ratio * s.ratio * terms_[k].variance + s.variance * terms_[k].sum * terms_[k].sum;
    }
    const auto n = static_cast<double>(film_.pixels.size());
    const bool probed = gains_.is_known();
    ErrorEstimate estimate;
    estimate.relmse = sum / n;
    estimate.standard_error = std::sqrt(variance) / n;
    // A pair of estimates tells once of the spread between them, n samples n - 1 times.
    estimate.degrees = probed ? static_cast<double>(film_.probes.size()) - 1
                              : std::max(n * (mean_samples() - 1.0), 1.0);
    estimate.probes = probed ? film_.probes.size() : 0;
    estimate.replicates = probed ? 2 : mean_samples();
    return estimate;
  }

 private:
  /// A pixel, without regard to order.
  struct Pixel {
    std::size_t index;
    double relative;
  };

  /// Pixels whose means rest on enough samples for errors to be relative to them; gathers the
  /// others.
  void add_known() {
    // As of 32 equally bright samples among black ones.
    constexpr double known = 1.0 / 32;
    for (std::size_t i = 0; i < film_.pixels.size(); ++i) {
      const PixelSums& pixel = film_.pixels[i];
      const double relative = relative_variance(variance_by_samples(pixel), pixel.mean(), epsilon_);
      if (relative > known) {
        unknown_.push_back({i, relative});
      } else {
        terms_[gains_.stratum_of(relative)].add(relative, 1);
      }
    }
  }

  /// A mean that rests on few samples is most often one that has been lucky: errors are relative to
  /// what the pixels like it have. That takes time, so of many pixels some stand for all.
  void add_unknown() {
    constexpr std::size_t most = 1U << 12U;
    const std::size_t step = (unknown_.size() + most - 1) / most;
    if (step == 0) return;
    const SimilarPixels similar(film_, epsilon_);
    std::vector<double> relative((unknown_.size() + step - 1) / step);
    parallel_for(relative.size(), 16, [&](std::size_t begin, std::size_t end) {
      // Its likes may be brighter than it is, as it may be brighter than its truth.
      for (std::size_t k = begin; k < end; ++k) {
        const Pixel& pixel = unknown_[k * step];
        relative[k] = std::max(pixel.relative, relative_to_likes(similar, pixel.index));
      }
    });
    const double weight =
        static_cast<double>(unknown_.size()) / static_cast<double>(relative.size());
    for (std::size_t k = 0; k < relative.size(); ++k)
      terms_[gains_.stratum_of(unknown_[k * step].relative)].add(relative[k], weight);
  }

  /// The mean of its likes is itself known by few flashes, k. Where every order of magnitude of
  /// their expected number is as likely as every other, (k + 2) k / ((k - 1) (k - 2)) times the
  /// plain ratio is to be expected: 1 + 5 / k + ..., of which more would hang on that assumption.
  /// And for each pixel that a single flash has lit there are some, about three, that none has, and
  /// which lack all of their light. The less so, the more epsilon decides what errors are relative
  /// to.
  [[nodiscard]] double relative_to_likes(const SimilarPixels& similar, std::size_t i) const {
    const auto width = static_cast<std::size_t>(film_.width);
    const SimilarPixels::Mean mean =
        similar.mean(static_cast<int>(i % width), static_cast<int>(i / width));
    Color3 variance = variance_by_samples(film_.pixels[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      const double square = mean.value[c] * mean.value[c];
      if (variance[c] > 0)
        variance[c] *= 1 + luck_of(mean.flashes[c]) * square / (square + 16 * epsilon_);
    }
    return relative_variance(variance, mean.value, epsilon_);
  }

  static double luck_of(double flashes) { return (5 + 3 / flashes) / flashes; }

  [[nodiscard]] std::uint32_t mean_samples() const {
    double samples = 0;
    for (const PixelSums& pixel : film_.pixels) samples += pixel.samples;
    return static_cast<std::uint32_t>(samples / static_cast<double>(film_.pixels.size()));
  }

  const Film& film_;
  double epsilon_;
  OrderGains gains_;
  std::vector<Terms> terms_;  ///< of each stratum, as if the samples were independent
  std::vector<Pixel> unknown_;
};

}  // namespace

ErrorEstimate estimate_error(const Film& film) {
  if (!film.has_squares || film.pixels.empty()) return {};
  return Errors(film).estimate();
}

double ErrorEstimate::relative_upper(double confidence) const {
  if (standard_error == 0) return relative();
  return std::sqrt(relmse + statistics::student_quantile(confidence, degrees) * standard_error);
}

ColorPlane standard_errors(const Film& film) {
  const double epsilon = relmse_epsilon(film);
  const OrderGains gains(film, epsilon);
  ColorPlane result(film.pixels.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const PixelSums& pixel = film.pixels[i];
    const Color3 variance = variance_by_samples(pixel);
    const double relative = relative_variance(variance, pixel.mean(), epsilon);
    const double ratio = gains.strata()[gains.stratum_of(relative)].ratio;
    for (std::size_t c = 0; c < 3; ++c) result[i][c] = std::sqrt(ratio * variance[c]);
  }
  return result;
}

Image with_errors(const Image& image, const ColorPlane& errors) {
  Image result = with_channels(image, {"error.R", "error.G", "error.B"});
  const auto first = static_cast<int>(image.channels().size());
  for (int c = 0; c < 3; ++c) {
    float* plane = result.plane(first + c);
    for (std::size_t i = 0; i < errors.size(); ++i)
      plane[i] = static_cast<float>(errors[i][static_cast<std::size_t>(c)]);
  }
  return result;
}

}  // namespace facet
