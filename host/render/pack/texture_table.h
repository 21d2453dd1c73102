#pragma once
// Textures as the kernels read them.
#include <cstdint>
#include <span>
#include <vector>

#include "scene/texture/texture.h"
#include "shared/records.h"

namespace facet {

struct TextureTable {
  std::vector<shared::TextureRecord> records;
  std::vector<std::uint32_t>
      texels;  ///< tables of what a byte stands for (bits of floats), then the images
};

[[nodiscard]] TextureTable make_texture_table(std::span<const Texture> textures);

}  // namespace facet
