#pragma once
// The rays that a path tracer traces: from the camera, after a diffuse bounce, towards a light.
#include <span>
#include <string>
#include <vector>

#include "render/pack/packed_scene.h"

namespace facet::bench {

struct RaySet {
  std::string kind;  ///< "camera", "diffuse", "shadow"
  bool any = false;  ///< whether any hit will do
  std::vector<shared::RayRecord> rays;
};

/// All three kinds. Bounces leave the camera rays' hits by the cosine's density; shadow rays end on
/// emitting triangles that face them, or go towards the sky. The order is that of the camera's
/// rays.
[[nodiscard]] std::vector<RaySet> make_ray_sets(const PackedScene& packed,
                                                std::span<const shared::RayRecord> camera_rays,
                                                std::span<const shared::HitRecord> camera_hits);

}  // namespace facet::bench
