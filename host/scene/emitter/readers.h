#pragma once
// One reader for each emitter of the shared list; their manuals are in shaders/emitter.
#include "scene/scene.h"
#include "scene/xml/property_reader.h"

namespace facet {

/// An area emitter, as the child of the mesh of that index.
[[nodiscard]] AreaEmitter read_area_emitter(PropertyReader& properties, std::uint32_t mesh);

/// A point light.
[[nodiscard]] PointLight read_point_light(PropertyReader& properties);

/// A constant or mapped environment.
[[nodiscard]] EnvironmentEmitter read_environment_emitter(PropertyReader& properties,
                                                          Diagnostics& diagnostics);

}  // namespace facet
