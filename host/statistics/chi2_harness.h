#pragma once
// Is a BSDF's `pdf` the density of what its `sample` draws? The chi-squared test, for lobes of any
// width.
#include <cstdint>
#include <string>
#include <vector>

#include "statistics/bsdf_evaluator.h"

namespace facet::statistics {

struct Chi2Options {
  std::uint32_t samples = 1'000'000;
  std::uint32_t seed = 1;  ///< of the samples; the pilot samples that make the bins have seed + 1
  std::uint32_t pilots = 1U << 17U;
  std::uint32_t bins = 256;
  /// Bins with an expected count of five and more that a BSDF with a density must have.
  std::uint32_t least_bins = 128;
  /// Factor on the weight of samples that cross the surface, to take radiance's scaling out of
  /// `weight`.
  float transmission_scale = 1;
};

/// A direction of a delta lobe, and how often it was drawn.
struct DeltaDirection {
  vec3 wi;
  std::uint64_t count = 0;
};

/// Mean over all samples, rejected ones counting 0, and the standard error of that mean; channel by
/// channel.
struct MeanWeight {
  dvec3 mean{0};
  dvec3 error{0};
};

struct Chi2Result {
  double statistic = 0;
  double degrees = 0;
  double p_value = 0;  ///< 0 also where anything is not a number
  std::uint32_t populated_bins = 0;
  double pdf_integral = 0;
  double integral_error =
      0;  ///< bound on the quadrature's error, by which the rejected mass may be off
  double rejected_share = 0;
  std::uint64_t evaluations = 0;  ///< of the density, for its integral
  std::uint64_t bad_samples =
      0;  ///< NaN, infinite or negative, or of a direction that is not a unit vector
  std::vector<DeltaDirection> deltas;
  MeanWeight weight;
  /// What is wrong at this significance: "" if nothing is.
  std::string fault;
};

/// One direction's test: counts of samples in bins of about equal mass against integrals of the
/// density, the rejected samples and those of delta lobes together against 1 less the whole
/// integral. Fails (`fault`) also for too few populated bins, for bad samples, and for more than
/// eight directions of delta lobes.
[[nodiscard]] Chi2Result test_sampling(BsdfEvaluator& evaluator, const vec3& wo,
                                       const Chi2Options& options, double significance);

}  // namespace facet::statistics
