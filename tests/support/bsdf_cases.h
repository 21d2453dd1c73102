#pragma once
// The parameters and directions that every BSDF of the shared list is tested with. A new one is
// tested with parameters that follow from their declaration; an overload of `variants` chooses
// others.
#include <string>
#include <vector>

#include "render/pack/parameter_records.h"
#include "scene/bsdf/traits.h"
#include "scene/settings.h"

namespace facet::test {

/// A BSDF with its parameters, and how its rough lobes are sampled.
struct BsdfCase {
  Bsdf bsdf;
  LobeSampling sampling = LobeSampling::visible;
  std::string name;
  std::size_t number = 0;  ///< among those of all BSDFs

  [[nodiscard]] bool has_flag(std::uint32_t flag) const {
    return (pack_bsdf(bsdf).flags & flag) != 0;
  }
  [[nodiscard]] bool transmits() const { return has_flag(shared::BSDF_TRANSMITS); }
  /// Roughness; 1 where there is none.
  [[nodiscard]] float alpha() const { return roughness_of(bsdf); }
  /// Index of refraction on w's side; 1 without indices.
  [[nodiscard]] double index_at(const vec3& w) const { return index_of_side(bsdf, w.z < 0); }
};

inline constexpr std::array roughnesses{1e-3F, 0.01F, 0.05F, 0.1F, 0.3F, 0.6F, 1.0F};

/// All cases of the BSDF of that id: each rough one with every roughness, distribution and
/// sampling.
[[nodiscard]] std::vector<BsdfCase> bsdf_cases(std::size_t id);

/// 25 directions of view from the normal to grazing, and ten from below where the BSDF transmits.
/// Narrow lobes are seen under a cosine of 0.02 at least: beyond, the float directions themselves
/// are too coarse for them.
[[nodiscard]] std::vector<vec3> view_directions(const BsdfCase& c);

/// Whether everything is to be tested that takes long (FACET_FULL_GRID in the environment).
[[nodiscard]] bool full_grid();

/// Indices of the directions that the case is sampled from: all, or two, others for every case.
[[nodiscard]] std::vector<std::size_t> sampled_directions(const BsdfCase& c, std::size_t count);

}  // namespace facet::test
