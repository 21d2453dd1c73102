#pragma once
// The emitters as the kernels read them.
#include <functional>
#include <vector>

#include "render/pack/environment_table.h"
#include "scene/settings.h"

namespace facet {

struct EmitterTable {
  std::vector<shared::EmitterRecord> emitters;  ///< first_index is left 0
  std::vector<shared::EmitterTriangle> triangles;
  /// Of each area emitter's triangles, in order of reading. Empty without a light tree.
  std::vector<shared::EmitterPlace> places;
  std::vector<shared::LightNode> light_nodes;  ///< empty where the scene or the settings need none
  EnvironmentTable environment;
  float environment_irradiance = 0;  ///< as in shared::FrameRecord
};

/// Places in the BVH of the triangles of a mesh.
using PlacesOfMesh = std::function<std::vector<std::uint32_t>(std::uint32_t mesh)>;

/// radius: half the diagonal of the scene's bounding box.
[[nodiscard]] EmitterTable make_emitter_table(const Scene& scene, const RenderSettings& settings,
                                              double radius, const PlacesOfMesh& places_of);

}  // namespace facet
