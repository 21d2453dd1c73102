#pragma once
#include "scene/texture/texture.h"
#include "scene/xml/property_reader.h"

namespace facet {

/// Reads a <texture>. Throws InputError with file and line, also for an image that is missing.
/// Warns of texels that no light can be.
[[nodiscard]] Texture read_texture(PropertyReader& properties, Diagnostics& diagnostics);

/// The image of an OBJ material: decoded from sRGB, its u from left to right (a `textmap` has it
/// from right to left). Throws InputError where it is missing; warnings name `where`.
[[nodiscard]] BitmapTexture read_material_map(const std::filesystem::path& path,
                                              const SourceLocation& where,
                                              Diagnostics& diagnostics);

}  // namespace facet
