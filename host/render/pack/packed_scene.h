#pragma once
// A scene as the kernels read it: arrays of the shared records.
#include <vector>

#include "accel/bvh.h"
#include "render/features.h"
#include "scene/settings.h"
#include "shared/binding_list.h"

namespace facet {

/// An array of a scene; large ones are not filled before they are written.
template <typename Record>
struct SceneArray {
  using Type = std::vector<Record>;
};
template <>
struct SceneArray<shared::BvhItem> {
  using Type = UnfilledVector<shared::BvhItem>;
};
template <>
struct SceneArray<shared::PairRecord> {
  using Type = UnfilledVector<shared::PairRecord>;
};

namespace shared {

/// What kernels read of a scene, by the list of bindings (shared/binding_list.h), in whose
/// namespace the records have the list's names.
struct SceneArrays {
#define FACET_ARRAY_scene(names, Record) SceneArray<Record>::Type names;
#define FACET_ARRAY_uniform(names, Record)
#define FACET_ARRAY_state(names, Record)
#define FACET_ARRAY_storage(names, Record)
#define FACET_ARRAY(number, kind, names, name, Record) FACET_ARRAY_##kind(names, Record)
  FACET_BINDING_LIST(FACET_ARRAY)
#undef FACET_ARRAY
#undef FACET_ARRAY_storage
#undef FACET_ARRAY_state
#undef FACET_ARRAY_uniform
#undef FACET_ARRAY_scene
};

}  // namespace shared

/// Triangles without area are left out of it. Of the arrays: normal and texture coordinate indices
/// are a triangle's by MeshRecord::attributes, x = none: without; those of texture coordinates are
/// empty where the scene has no textures, albedos where no BSDF gives back the energy of multiple
/// scattering.
struct PackedScene : shared::SceneArrays {
  RenderSettings settings;  ///< for which it is packed
  Features features;        ///< to which the kernels are specialised
  BvhFacts bvh;             ///< of the items and pairs
  shared::FrameRecord frame{};
  double bvh_seconds = 0;

  [[nodiscard]] std::size_t triangle_count() const { return bvh.places.size(); }
  /// The triangle at a place of the BVH, its corners in the scene's order.
  [[nodiscard]] TriangleCorners triangle(std::uint32_t place) const {
    return triangle_at(place, items, pairs);
  }
  /// Index in the scene, in order of reading, of the triangle at a place of the BVH.
  [[nodiscard]] std::uint32_t scene_index(std::uint32_t place) const {
    const shared::PairRecord& pair = pairs[place / 2];
    return (place % 2 == 0 ? pair.name0 : pair.name1) & shared::NAME_INDEX_MASK;
  }
};

/// Of an array of records.
template <typename Records>
std::size_t bytes_of(const Records& records) {
  return records.size() * sizeof(typename Records::value_type);
}

[[nodiscard]] PackedScene pack_scene(const Scene& scene, const RenderSettings& settings);

}  // namespace facet
