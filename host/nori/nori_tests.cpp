#include "nori/nori_tests.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "statistics/hypothesis.h"
#include "statistics/pearson.h"

namespace facet::nori {

using statistics::BsdfDraw;
using statistics::Count;
using statistics::Pearson;
using statistics::Pilot;
using statistics::student_p_value;

namespace {

/// Samples that are drawn in one call.
constexpr std::uint32_t samples_per_call = 1U << 20U;
/// Samples whose directions guide the integration.
constexpr std::size_t guiding_samples = 1U << 17U;
/// By which a cell of the integration may be off.
constexpr double tolerated_samples = 0.5;
/// Of the density, at most.
constexpr std::uint64_t most_evaluations = 4'000'000;
constexpr double most_pixels = 1U << 18U;
/// Nori's least variance, for a reference of 1.
constexpr double least_variance = 1e-5;
/// Nori's share of samples that may fall where none is expected.
constexpr double forgiven_share = 1e-5;
/// A density whose integral is this close to 1 is taken to integrate to 1.
constexpr double unit_tolerance = 1e-4;

bool is_finite(const vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Calls body with all samples, in portions of their own seeds.
template <typename Body>
void for_each_draw(BsdfEvaluator& bsdf, const vec3& wo, std::uint32_t count, std::uint32_t seed,
                   const Body& body) {
  for (std::uint32_t done = 0; done < count; done += samples_per_call, ++seed) {
    for (const BsdfDraw& draw : bsdf.sample(wo, std::min(samples_per_call, count - done), seed))
      body(draw);
  }
}

/// Mean and variance as samples come (B. P. Welford, Technometrics 4, 1962).
struct Moments {
  double count = 0;
  double mean = 0;
  double squares = 0;  ///< of distances to the mean, summed

  void add(double x) {
    const double before = x - mean;
    mean += before / ++count;
    squares += before * (x - mean);
  }
  [[nodiscard]] double variance() const { return count > 1 ? squares / (count - 1) : 0; }
};

}  // namespace

Estimate sample_albedo(BsdfEvaluator& bsdf, double angle, std::uint32_t count, std::uint32_t seed) {
  const double theta = glm::radians(angle);
  const vec3 wo(std::sin(theta), 0, std::cos(theta));
  Estimate e;
  Moments moments;
  for_each_draw(bsdf, wo, count, seed, [&](const BsdfDraw& draw) {
    if (is_finite(draw.weight)) {
      moments.add(luminance(draw.weight));
    } else {
      ++e.bad_samples;
    }
  });
  e.mean = moments.mean;
  e.samples = moments.count;
  e.standard_error = std::sqrt(moments.variance() / std::max(moments.count, 1.0));
  e.degrees = moments.count - 1;
  return e;
}

Estimate mean_luminance(const SampleRenderer& render, std::uint32_t passes) {
  std::vector<Moments> pixels;
  Estimate e;
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    const std::vector<Radiance> radiances = render(pass);
    pixels.resize(radiances.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const vec3 radiance(radiances[i][0], radiances[i][1], radiances[i][2]);
      if (is_finite(radiance)) {
        pixels[i].add(luminance(radiance));
      } else {
        ++e.bad_samples;
      }
    }
  }
  double variances = 0;
  double squares = 0;
  for (const Moments& pixel : pixels) {
    const double v = pixel.variance() / std::max(pixel.count, 1.0);
    e.mean += pixel.mean;
    e.samples += pixel.count;
    variances += v;
    squares += v * v / std::max(pixel.count - 1, 1.0);
  }
  const auto n = static_cast<double>(std::max<std::size_t>(pixels.size(), 1));
  e.mean /= n;
  e.standard_error = std::sqrt(variances) / n;
  e.degrees = squares > 0 ? variances * variances / squares : e.samples - n;
  return e;
}

ImagePlan plan_image(int width, int height, std::uint32_t sample_count) {
  const int divisor = std::gcd(width, height);
  ImagePlan plan{width / divisor, height / divisor, 2};
  const double shape = static_cast<double>(plan.width) * plan.height;
  const double pixels = std::min(most_pixels, sample_count / 4.0);
  const int scale = std::max(1, static_cast<int>(std::sqrt(pixels / shape)));
  plan.width *= scale;
  plan.height *= scale;
  plan.passes =
      std::max(2U, static_cast<std::uint32_t>(std::ceil(sample_count / (shape * scale * scale))));
  return plan;
}

Verdict t_test(const Estimate& estimate, double reference, double significance) {
  Verdict v;
  v.degrees = estimate.degrees;
  if (estimate.bad_samples > 0) {
    v.note = fmt::format("{} samples are NaN or infinite", estimate.bad_samples);
    return v;
  }
  const double least = std::abs(reference) * std::sqrt(least_variance / estimate.samples);
  const double error = std::max(estimate.standard_error, least);
  const double difference = estimate.mean - reference;
  if (error == 0) {
    v.passed = difference == 0;
    v.p_value = v.passed ? 1 : 0;
    if (!v.passed) v.note = "the mean differs, and has no variance";
    return v;
  }
  v.statistic = difference / error;
  v.p_value = student_p_value(v.statistic, v.degrees);
  v.passed = v.p_value >= significance;
  return v;
}

std::optional<SphereHistogram> make_histogram(BsdfEvaluator& bsdf, const vec3& wo, int resolution,
                                              std::uint32_t count, std::uint32_t seed) {
  SphereHistogram histogram(resolution, 2 * resolution);
  histogram.samples = count;
  const statistics::SphereCoordinates coordinates;
  std::vector<Pilot> pilots;
  std::vector<statistics::DirectionPair> pairs;
  for_each_draw(bsdf, wo, count, seed, [&](const BsdfDraw& draw) {
    if (draw.weight == vec3(0) || draw.pdf < 0) return;
    const statistics::Coordinates at = coordinates.of(draw.wi);
    histogram.observed[histogram.bin(at)] += 1;
    if (pilots.size() == guiding_samples) return;
    pilots.push_back({at, 0});
    pairs.push_back({wo, draw.wi});
  });
  // By the density that is integrated, whatever samples say of their own.
  const std::vector<statistics::BsdfValue> values = bsdf.evaluate(pairs);
  for (std::size_t i = 0; i < pilots.size(); ++i) pilots[i].pdf = values[i].pdf;
  statistics::QuadratureOptions options;
  options.most_evaluations = most_evaluations;
  options.tolerance = std::min(options.tolerance, tolerated_samples / count);
  const statistics::DensityIntegral integral = statistics::integrate_density(
      bsdf, wo, coordinates, histogram.cells(pilots), histogram.expected.size(), options);
  if (integral.error > unit_tolerance) return std::nullopt;
  for (std::size_t i = 0; i < histogram.expected.size(); ++i)
    histogram.expected[i] = integral.bins[i] * count;
  return histogram;
}

Verdict chi_squared_test(const SphereHistogram& h, double least_expected, double significance) {
  Verdict v;
  const double expected = std::accumulate(h.expected.begin(), h.expected.end(), 0.0);
  const double observed = std::accumulate(h.observed.begin(), h.observed.end(), 0.0);
  if (!std::isfinite(expected) || expected > h.samples * (1 + unit_tolerance)) {
    v.note = fmt::format("the density integrates to {:.6g}, more than 1", expected / h.samples);
    return v;
  }
  std::vector<Count> bins;
  for (std::size_t i = 0; i < h.expected.size(); ++i)
    bins.push_back({h.expected[i], h.observed[i]});
  if (expected < h.samples * (1 - unit_tolerance))
    bins.push_back({h.samples - expected, h.samples - observed});
  const Pearson pearson(std::move(bins), least_expected, h.samples * forgiven_share);
  v.statistic = pearson.statistic();
  v.degrees = pearson.degrees();
  if (pearson.has_impossible()) {
    v.note = "samples fall where the density is 0";
  } else if (v.degrees < 1) {
    v.note = "nothing to test: all samples belong to one bin or to delta lobes";
  } else {
    v.p_value = pearson.p_value();
    v.passed = v.p_value >= significance;
  }
  return v;
}

}  // namespace facet::nori
