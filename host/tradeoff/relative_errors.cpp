#include "tradeoff/relative_errors.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "compare/metrics.h"
#include "compare/z_test.h"
#include "convergence/error_estimate.h"
#include "core/error.h"
#include "image/files.h"
#include "image/record.h"
#include "statistics/hypothesis.h"

namespace facet::tradeoff {

namespace {

constexpr double any_tolerance = 1;

/// relMSE's epsilon for a reference.
double epsilon_of(const Image& reference) {
  return measure_errors(reference, reference, any_tolerance).epsilon();
}

/// Variances of a pixel's channels over (r^2 + epsilon), their mean.
using VarianceOf = std::function<double(std::size_t pixel, std::size_t channel)>;

std::vector<double> relative_noise(const Image& image, const VarianceOf& variance) {
  const double epsilon = epsilon_of(image);
  const auto planes = rgb_planes(image);
  const auto pixels =
      static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  std::vector<double> noise(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double r = planes[c][i];
      const double weight = r * r + epsilon;
      if (weight > 0) noise[i] += variance(i, c) / weight / 3;
    }
  }
  return noise;
}

/// What is left of a sum when its largest terms, as many as are trimmed, are taken away; the mean.
double trimmed_mean(std::vector<double> terms, std::size_t trimmed) {
  const auto kept = static_cast<std::ptrdiff_t>(terms.size() - trimmed);
  std::ranges::nth_element(terms, terms.begin() + kept);
  return std::accumulate(terms.begin(), terms.begin() + kept, 0.0) / static_cast<double>(kept);
}

using Planes = std::array<const float*, 3>;

std::vector<Planes> planes_of(std::span<const Image> images) {
  std::vector<Planes> planes;
  planes.reserve(images.size());
  for (const Image& image : images) planes.push_back(rgb_planes(image));
  return planes;
}

double difference(const Planes& a, const Planes& b, std::size_t channel, std::size_t pixel) {
  return static_cast<double>(a.at(channel)[pixel]) - static_cast<double>(b.at(channel)[pixel]);
}

/// Estimates the square of the mean of what `difference` is a noisy estimate of, image by image, in
/// every pixel: the square of the mean over the images less the variance of that mean.
template <typename Difference>
double bias_of(std::size_t images, const Reference& reference, bool with_noise,
               const Difference& difference) {
  const double epsilon = epsilon_of(reference.image);
  const auto planes = rgb_planes(reference.image);
  const auto pixels = static_cast<std::size_t>(reference.image.width()) *
                      static_cast<std::size_t>(reference.image.height());
  const auto n = static_cast<double>(images);
  double sum = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    double term = with_noise && !reference.noise.empty() ? -reference.noise[i] : 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double r = planes[c][i];
      const double weight = r * r + epsilon;
      if (!(weight > 0)) continue;
      double mean = 0;
      for (std::size_t k = 0; k < images; ++k) mean += difference(k, c, i) / n;
      double variance = 0;
      for (std::size_t k = 0; k < images; ++k) {
        const double d = difference(k, c, i) - mean;
        variance += d * d / (n - 1);
      }
      term += (mean * mean - variance / n) / weight / 3;
    }
    sum += term;
  }
  return std::sqrt(std::max(0.0, sum / static_cast<double>(pixels)));
}

}  // namespace

double Reference::relmse() const {
  if (noise.empty()) return 0;
  return std::accumulate(noise.begin(), noise.end(), 0.0) / static_cast<double>(noise.size());
}

Reference make_reference(const Film& film) {
  Reference reference;
  reference.image = develop(film, true);
  reference.samples = film.record.samples.count();
  reference.how = film.record.integrator + ", " + film.record.sampler;
  const ColorPlane errors = standard_errors(film);
  reference.noise = relative_noise(reference.image, [&](std::size_t pixel, std::size_t channel) {
    return errors[pixel].at(channel) * errors[pixel].at(channel);
  });
  return reference;
}

Reference read_reference(const std::string& file) {
  Reference reference;
  reference.file = file;
  reference.image = read_image(file);
  for (const float* plane : rgb_planes(reference.image)) {
    const auto pixels = static_cast<std::ptrdiff_t>(reference.image.width()) *
                        static_cast<std::ptrdiff_t>(reference.image.height());
    if (!std::all_of(plane, plane + pixels, [](float v) { return std::isfinite(v); }))
      throw InputError(fmt::format("{}: a reference has finite pixels alone", file));
  }
  const ParsedRecord parsed = parse_record(reference.image.metadata);
  reference.samples = parsed.record.samples.count();
  reference.how = parsed.record.integrator;
  std::array<const float*, 3> variances{};
  if (reference.image.find_channel("samples.nonzero") < 0) return reference;
  for (std::size_t c = 0; c < 3; ++c) {
    const int channel = reference.image.find_channel(std::string("variance.") + "RGB"[c]);
    if (channel < 0) return reference;
    variances.at(c) = reference.image.plane(channel);
  }
  reference.noise = relative_noise(reference.image, [&](std::size_t pixel, std::size_t channel) {
    return variances.at(channel)[pixel];
  });
  return reference;
}

RelativeError relative_error(const Image& image, const Reference& reference) {
  const ErrorMetrics errors = measure_errors(image, reference.image, any_tolerance);
  if (reference.noise.empty()) return {errors.relmse, errors.relmse_trimmed};
  return {errors.relmse - reference.relmse(),
          errors.relmse_trimmed - trimmed_mean(reference.noise, errors.trimmed)};
}

bool is_biased(const Film& film, const Reference& reference, double significance) {
  if (reference.noise.empty()) return false;
  const Image image = develop(film, true);
  // Small cells show what is local, large ones what is faint.
  constexpr std::array least{1, largest_cell};
  const double each = statistics::sidak_significance(significance, least.size());
  return std::ranges::any_of(least, [&](int cell) {
    const ZTestResult result = z_test(image, reference.image, each, {cell, 1000});
    // What cannot be tested is not held against it.
    return result.largest_z > result.critical_z;
  });
}

double measure_bias(std::span<const Image> images, const Reference& reference) {
  const Planes truth = rgb_planes(reference.image);
  const std::vector<Planes> planes = planes_of(images);
  return bias_of(images.size(), reference, true,
                 [&](std::size_t image, std::size_t channel, std::size_t pixel) {
                   return difference(planes[image], truth, channel, pixel);
                 });
}

double measure_bias(std::span<const Image> images, std::span<const Image> plain,
                    const Reference& reference) {
  const std::vector<Planes> planes = planes_of(images);
  const std::vector<Planes> plain_planes = planes_of(plain);
  return bias_of(images.size(), reference, false,
                 [&](std::size_t image, std::size_t channel, std::size_t pixel) {
                   return difference(planes[image], plain_planes[image], channel, pixel);
                 });
}

}  // namespace facet::tradeoff
