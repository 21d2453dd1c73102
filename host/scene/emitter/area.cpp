#include "scene/emitter/parameters.h"
#include "scene/emitter/readers.h"
#include "scene/plugin/parameter_reader.h"

namespace facet {

void AreaParameters::check(const PropertyReader& properties) const {
  if (!glm::all(glm::lessThanEqual(scaled_radiance(), Color(largest_radiance))))
    properties.fail("scale", fmt::format("makes the radiance more than {:g}", largest_radiance));
}

AreaEmitter read_area_emitter(PropertyReader& properties, std::uint32_t mesh) {
  const auto given = read_parameters<AreaParameters>(properties);
  return {mesh, given.scaled_radiance(), given.radiance.texture};
}

}  // namespace facet
