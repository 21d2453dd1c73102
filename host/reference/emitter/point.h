#pragma once
#include "reference/emitter/sample.h"
#include "reference/surface.h"
#include "scene/emitter/light_tree.h"

namespace facet::reference {

/// Light from a point, equal in all directions.
template <typename Real>
class PointSource {
 public:
  explicit PointSource(const PointLight& light)
      : position_(light.position),
        intensity_(light.intensity),
        power_(4 * std::numbers::pi * static_cast<double>(luminance(light.intensity))) {}

  /// Weight of power selection, W of white light.
  [[nodiscard]] double power(const Box& /*bounds*/) const { return power_; }

  /// As a source of a light tree.
  [[nodiscard]] LightSource source() const {
    LightSource s;
    s.box.add(vec3(position_));
    s.energy = power_ / (4 * std::numbers::pi);
    return s;
  }

  template <typename Probe>
  [[nodiscard]] EmitterSample<Real> sample(const Surface<Real>& from,
                                           const EmitterNumbers& /*numbers*/, Probe& probe) const {
    const Vec3<Real> way = position_ - from.position;
    EmitterSample<Real> s;
    s.direction = probe.nudged(unit(way));
    s.radiance = intensity_ / glm::dot(way, way);
    s.pdf = 1;
    s.end = position_;
    s.is_point = true;
    return s;
  }

 private:
  Vec3<Real> position_;
  Vec3<Real> intensity_;
  double power_;
};

}  // namespace facet::reference
