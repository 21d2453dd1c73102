#pragma once
// A scene as the kernels read it: arrays of the shared records.
#include <vector>

#include "accel/bvh.h"
#include "render/features.h"
#include "render/pack/environment_table.h"
#include "render/pack/filter_table.h"
#include "scene/settings.h"

namespace facet {

struct PackedScene {
  RenderSettings settings;  ///< for which it is packed
  Features features;        ///< to which the kernels are specialised
  Bvh bvh;                  ///< triangles without area are left out
  std::vector<glm::uvec4>
      normal_indices;              ///< a triangle's by MeshRecord::attributes; x = none: without
  std::vector<glm::vec4> normals;  ///< xyz
  std::vector<glm::uvec4> texcoord_indices;  ///< likewise; empty where the scene has no textures
  std::vector<vec2> texcoords;
  std::vector<shared::TextureRecord> textures;
  std::vector<std::uint32_t> texels;
  std::vector<float> albedos;  ///< empty where no BSDF gives back the energy of multiple scattering
  std::vector<shared::MeshRecord> meshes;
  std::vector<shared::BsdfRecord> bsdfs;
  std::vector<shared::EmitterRecord> emitters;
  std::vector<shared::EmitterTriangle> emitter_triangles;
  EnvironmentTable environment;
  FilterTable filter;
  shared::FrameRecord frame{};
  double bvh_seconds = 0;

  [[nodiscard]] std::size_t triangle_count() const { return bvh.places.size(); }
  /// Index in the scene, in order of reading, of the triangle at a place of the BVH.
  [[nodiscard]] std::uint32_t scene_index(std::uint32_t place) const {
    const shared::PairRecord& pair = bvh.pairs[place / 2];
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
