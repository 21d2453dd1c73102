#pragma once
// Rays from the camera (docs/reference/sampling.md, "Camera and filter").
#include "reference/filter.h"
#include "reference/geometry.h"
#include "reference/random.h"

namespace facet::reference {

/// A sample's place in its pixel.
template <typename Real>
struct FilterSample {
  Real x = 0;  ///< offsets from the pixel's centre, pixels
  Real y = 0;
  Real weight = 1;
};

template <typename Real>
class PerspectiveCamera {
 public:
  explicit PerspectiveCamera(const Camera& camera)
      : filter_(camera.filter),
        width_(static_cast<Real>(camera.width)),
        height_(static_cast<Real>(camera.height)),
        to_world_(camera.to_world),
        origin_(dvec3(camera.to_world[3])),
        near_(static_cast<Real>(camera.near_clip)),
        far_(static_cast<Real>(camera.far_clip)) {
    const double tangent = std::tan(glm::radians(camera.fov) / 2);
    half_width_ = static_cast<Real>(tangent);
    half_height_ = static_cast<Real>(tangent * camera.height / camera.width);
  }

  [[nodiscard]] FilterSample<Real> filter_sample(const SampleId& id) const {
    const Block block = camera_block(id);
    FilterSample<Real> s;
    s.x = filter_.offset(block.number<Real>(shared::CAMERA_FILTER_X));
    s.y = filter_.offset(block.number<Real>(shared::CAMERA_FILTER_Y));
    s.weight = filter_.weight(s.x) * filter_.weight(s.y);
    return s;
  }

  /// The ray through a place in pixel (x, y) of the image.
  template <typename Probe>
  [[nodiscard]] Ray<Real> ray(int x, int y, const FilterSample<Real>& place, Probe& probe) const {
    const Real px = static_cast<Real>(x) + Real(0.5) + place.x;
    const Real py = static_cast<Real>(y) + Real(0.5) + place.y;
    const Vec3<Real> local((1 - 2 * px / width_) * half_width_,
                           (1 - 2 * py / height_) * half_height_, 1);
    const Vec3<Real> d = to_world_ * local;
    const Vec3<Real> direction = probe.nudged(unit(d));
    const Real length = glm::dot(d, direction);
    return {probe.nudged(origin_), direction, near_ * length, far_ * length};
  }

 private:
  FilterProfile filter_;
  Real width_;
  Real height_;
  glm::mat<3, 3, Real> to_world_;
  Vec3<Real> origin_;
  Real near_;
  Real far_;
  Real half_width_ = 0;
  Real half_height_ = 0;
};

}  // namespace facet::reference
