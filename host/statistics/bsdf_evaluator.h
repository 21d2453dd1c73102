#pragma once
// One BSDF, evaluated and sampled in bulk: what statistical tests ask of the kernels or of the
// reference.
#include <cstdint>
#include <span>
#include <vector>

#include "core/maths.h"

namespace facet::statistics {

/// Unit directions in the shading frame.
struct DirectionPair {
  vec3 wo;
  vec3 wi;
};

/// Value f(wo, wi) and density of wi under sample, both in sr^-1; 0 for delta lobes.
struct BsdfValue {
  vec3 f;
  float pdf = 0;
};

/// What a sample gives. pdf < 0: a delta lobe's direction. weight 0: rejected.
struct BsdfDraw {
  vec3 wi;
  float pdf = 0;
  vec3 weight;
};

/// Numbers of a sample, each in [0, 1 - 2^-24].
struct BsdfNumbers {
  float lobe = 0;
  float u = 0;
  float v = 0;
};

/// A sample's direction of view, unit, in the shading frame, and its numbers.
struct BsdfQuery {
  vec3 wo;
  BsdfNumbers numbers;
};

/// Evaluates one BSDF, wherever that happens.
class BsdfEvaluator {
 public:
  BsdfEvaluator() = default;
  virtual ~BsdfEvaluator() = default;
  BsdfEvaluator(const BsdfEvaluator&) = delete;
  BsdfEvaluator& operator=(const BsdfEvaluator&) = delete;

  [[nodiscard]] virtual std::vector<BsdfValue> evaluate(std::span<const DirectionPair> pairs) = 0;
  /// One sample for each triple of numbers.
  [[nodiscard]] virtual std::vector<BsdfDraw> sample(const vec3& wo,
                                                     std::span<const BsdfNumbers> numbers) = 0;
  /// `count` samples whose numbers are those of docs/reference/sampling.md for pixel 0, samples 0,
  /// 1, ... and a seed.
  [[nodiscard]] virtual std::vector<BsdfDraw> sample(const vec3& wo, std::uint32_t count,
                                                     std::uint32_t seed) = 0;
};

}  // namespace facet::statistics
