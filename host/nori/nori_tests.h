#pragma once
// Nori's statistical tests of BSDFs and scenes (docs/reference/statistics.md).
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "scene/test.h"
#include "scene/testable_backend.h"
#include "statistics/sphere_histogram.h"

namespace facet::nori {

using statistics::BsdfEvaluator;
using statistics::SphereHistogram;

/// A mean, estimated from samples.
struct Estimate {
  double mean = 0;
  double standard_error = 0;
  double degrees = 0;  ///< of freedom, of the standard error
  double samples = 0;
  double bad_samples = 0;  ///< NaN or infinite; left out of the mean
};

/// What a test says.
struct Verdict {
  double statistic = 0;
  double degrees = 0;
  double p_value = 0;
  bool passed = false;
  std::string note;  ///< why it failed, where not for its p-value
};

/// Mean luminance of a BSDF's sample weights (its albedo), seen at an angle to the normal in
/// degrees.
[[nodiscard]] Estimate sample_albedo(BsdfEvaluator& bsdf, double angle, std::uint32_t count,
                                     std::uint32_t seed);

/// Radiances of one sample of every pixel, unweighted. Numbers of samples are called in order from
/// 0.
using SampleRenderer = std::function<std::vector<Radiance>(std::uint32_t sample)>;

/// Mean luminance of an image from at least two samples of every pixel: pixels are strata, so only
/// the variance within them counts; degrees of freedom by Satterthwaite (Biometrics Bulletin 2,
/// 1946).
[[nodiscard]] Estimate mean_luminance(const SampleRenderer& render, std::uint32_t passes);

/// The size of an image, and samples of every pixel.
struct ImagePlan {
  int width = 1;
  int height = 1;
  std::uint32_t passes = 2;
};

/// An image of the same shape, of at most 2^18 pixels where the shape allows it, and at least 4
/// samples of each pixel (2 where the shape asks for many), `sample_count` or more in all.
[[nodiscard]] ImagePlan plan_image(int width, int height, std::uint32_t sample_count);

/// Student's t-test of a mean against a reference, two-sided. As in Nori, a sample's variance
/// counts as 1e-5 at least (here times the reference squared), so that rounding does not decide
/// where there is no noise.
[[nodiscard]] Verdict t_test(const Estimate& estimate, double reference, double significance);

/// Counts `count` samples of a BSDF seen from wo and integrates its density; delta lobes' samples
/// and rejected ones fall in no bin. Nothing where the density cannot be integrated.
[[nodiscard]] std::optional<SphereHistogram> make_histogram(BsdfEvaluator& bsdf, const vec3& wo,
                                                            int resolution, std::uint32_t count,
                                                            std::uint32_t seed);

/// Pearson's chi^2 test of observed against expected. Bins that expect fewer than `least_expected`
/// are pooled; what falls in no bin is one bin more where the density does not integrate to 1. As
/// in Nori, 1e-5 of the samples are forgiven in a bin that expects nothing.
[[nodiscard]] Verdict chi_squared_test(const SphereHistogram& histogram, double least_expected,
                                       double significance);

/// One line of a test's report.
struct TestCase {
  std::string name;
  SourceLocation where;  ///< the object under test
  Verdict verdict;
  // Of a t-test:
  Estimate estimate;
  double reference = 0;
  // Of a chi^2 test:
  std::optional<SphereHistogram> histogram;
  std::uint64_t bound_hits = 0;  ///< rays that were stopped by their safety bound
};

/// Runs all cases on a backend; each is handed to `report` when it is done, which returns whether
/// to go on. Every direction and every number follows from the seed.
void run_test(const StatisticalTest& test, TestableBackend& backend, LobeSampling sampling,
              std::uint32_t seed, const std::function<bool(const TestCase&)>& report);

}  // namespace facet::nori
