#include "scene/emitter/readers.h"

namespace facet {

PointLight read_point_light(PropertyReader& properties) {
  const PointLight defaults;
  return {properties.point("position", defaults.position),
          properties.radiance("radiance", defaults.intensity)};
}

}  // namespace facet
