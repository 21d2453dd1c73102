#pragma once
// What the scene says of BSDFs, emitters and textures as the kernels read it.
#include "scene/scene.h"
#include "shared/records.h"

namespace facet {

/// The whole record.
[[nodiscard]] shared::BsdfRecord pack_bsdf(const Bsdf& bsdf);
/// Type and parameters.
[[nodiscard]] shared::EmitterRecord pack_emitter(const Emitter& emitter);
/// Parameters.
[[nodiscard]] shared::TextureRecord pack_texture(const Texture& texture);

}  // namespace facet
