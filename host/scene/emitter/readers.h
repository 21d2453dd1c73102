#pragma once
// Readers of emitters that are more than their parameters; manuals in shaders/emitter.
#include "scene/scene.h"
#include "scene/xml/property_reader.h"

namespace facet {

/// An area emitter, as the child of the mesh of that index.
[[nodiscard]] AreaEmitter read_area_emitter(PropertyReader& properties, std::uint32_t mesh);

/// A constant or mapped environment.
[[nodiscard]] EnvironmentEmitter read_environment_emitter(PropertyReader& properties,
                                                          Diagnostics& diagnostics);

}  // namespace facet
