#include "scene/emitter/readers.h"

namespace facet {

AreaEmitter read_area_emitter(PropertyReader& properties, std::uint32_t mesh) {
  const Color radiance = properties.radiance("radiance", Color(1));
  const double scale = properties.real("scale", 1);
  if (scale < 0) properties.fail("scale", "must not be negative");
  return {mesh, radiance * static_cast<float>(scale)};
}

}  // namespace facet
