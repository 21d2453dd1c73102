#pragma once
#include "scene/texture/texture.h"
#include "scene/xml/property_reader.h"

namespace facet {

/// Reads a <texture>. Throws InputError with file and line, also for an image that is missing.
[[nodiscard]] Texture read_texture(PropertyReader& properties);

}  // namespace facet
