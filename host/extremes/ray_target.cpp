#include "extremes/ray_target.h"

#include <fmt/format.h>

namespace facet::extremes {

namespace {

PackedScene packed_alone(const TriangleMesh& mesh) {
  SceneMaker maker;
  maker.integrator({"depth"});
  maker.camera(camera({1, 1}, 30, {.origin = {0, 0, 0}, .target = {0, 0, 1}}));
  maker.mesh(mesh, {"diffuse"});
  const ScenePtr scene = maker.scene();
  return pack_scene(*scene, resolve(*scene, {}));
}

}  // namespace

std::string ray_text(const Ray& ray) {
  const vec4& o = ray.origin;
  const vec4& d = ray.direction;
  return fmt::format("from ({:.9g}, {:.9g}, {:.9g}) along ({:.9g}, {:.9g}, {:.9g})", o.x, o.y, o.z,
                     d.x, d.y, d.z);
}

Ray ray_to(const vec3& from, const vec3& to) { return {vec4(from, 0), vec4(to - from, far_away)}; }

Check ray_row(const char* name, const char* range, const char* unit, double limit) {
  return make_check("rays and triangles", name, range, unit, limit);
}

RayTarget::RayTarget(Bench& bench, const TriangleMesh& mesh)
    : packed_(packed_alone(mesh)), tracer_(bench.device(), packed_, most_rays) {}

std::vector<shared::HitRecord> RayTarget::closest(std::span<const Ray> rays) {
  tracer_.set_rays(rays);
  tracer_.trace_closest();
  check_bound();
  return tracer_.hits();
}

std::vector<bool> RayTarget::any(std::span<const Ray> rays) {
  tracer_.set_rays(rays);
  tracer_.trace_any();
  check_bound();
  return tracer_.occluded();
}

Corners RayTarget::corners(std::uint32_t triangle) const {
  const TriangleCorners t = packed_.triangle(triangle);
  return {dvec3(t[0]), dvec3(t[1]), dvec3(t[2])};
}

void RayTarget::check_bound() const {
  if (tracer_.bound_hits() > 0) throw DeviceError("a traversal was stopped by its safety bound");
}

}  // namespace facet::extremes
