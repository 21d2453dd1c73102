#pragma once
// BSDFs with parameters at their extremes, and directions at the edges for them.
#include <random>
#include <string>
#include <vector>

#include "scene/bsdf/bsdf.h"
#include "scene/settings.h"
#include "statistics/bsdf_evaluator.h"

namespace facet::extremes {

/// A BSDF, how its rough lobes are sampled, and what it is in words.
struct BsdfCase {
  Bsdf bsdf;
  LobeSampling sampling = LobeSampling::visible;
  std::string name;
  double alpha = 1;    ///< roughness; 1 where there is none
  double ext_ior = 1;  ///< indices of refraction, 1 without
  double int_ior = 1;
  bool transmits = false;
  bool is_delta = false;  ///< has delta lobes alone
};

/// Cases of the BSDF with that id, whose declared parameters take their extreme values, and some
/// between, in turn.
[[nodiscard]] std::vector<BsdfCase> bsdf_cases(std::size_t id);

/// Numbers that are the same everywhere, unlike those of the standard library's distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// In [0, 1).
  double number() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  std::uint64_t below(std::uint64_t count) { return engine_() % count; }

 private:
  std::mt19937_64 engine_;
};

/// A direction of view: anywhere, along or all but along the normal, or grazing down to a cosine of
/// 1e-7; from below now and then where the BSDF transmits.
[[nodiscard]] vec3 view_direction(const BsdfCase& c, Random& random);

/// Such a one with another: in the lobe of reflection or of refraction, or as the first, or all but
/// the same, or all but opposite.
[[nodiscard]] statistics::DirectionPair direction_pair(const BsdfCase& c, Random& random);

/// Numbers of a sample, often the least or the largest.
[[nodiscard]] statistics::BsdfNumbers sample_numbers(Random& random);

}  // namespace facet::extremes
