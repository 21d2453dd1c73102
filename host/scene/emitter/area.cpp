#include "scene/emitter/readers.h"
#include "scene/plugin/parameter_reader.h"

namespace facet {

void AreaEmitter::check(const PropertyReader& properties) const {
  if (!glm::all(glm::lessThanEqual(emitted().value, Color(largest_radiance))))
    properties.fail("scale", fmt::format("makes the radiance more than {:g}", largest_radiance));
}

AreaEmitter read_area_emitter(PropertyReader& properties, std::uint32_t mesh) {
  return read_parameters<AreaEmitter>(properties, {.mesh = mesh});
}

}  // namespace facet
