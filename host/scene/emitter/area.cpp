#include <algorithm>

#include "scene/emitter/readers.h"

namespace facet {

AreaEmitter read_area_emitter(PropertyReader& properties, std::uint32_t mesh) {
  const double scale = properties.real("scale", 1);
  if (scale < 0) properties.fail("scale", "must not be negative");
  const double most = std::min(static_cast<double>(largest_radiance),
                               static_cast<double>(largest_radiance) / scale);
  const std::uint32_t texture = properties.texture("radiance", static_cast<float>(most));
  const Color radiance = texture == none ? properties.radiance("radiance", Color(1)) : Color(1);
  const Color scaled(dvec3(radiance) * scale);
  if (!glm::all(glm::lessThanEqual(scaled, Color(largest_radiance)))) {
    properties.fail("scale", fmt::format("makes the radiance more than {:g}", largest_radiance));
  }
  return {mesh, scaled, texture};
}

}  // namespace facet
