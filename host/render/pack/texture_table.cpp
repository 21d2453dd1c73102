#include "render/pack/texture_table.h"

#include <algorithm>
#include <bit>

#include "render/pack/parameter_records.h"

namespace facet {

namespace {

/// Adds a table of decoded bytes; returns where it begins.
std::uint32_t add_decoding(std::vector<std::uint32_t>& texels, bool srgb) {
  const auto first = static_cast<std::uint32_t>(texels.size());
  for (const float value : byte_values(srgb)) texels.push_back(std::bit_cast<std::uint32_t>(value));
  return first;
}

}  // namespace

TextureTable make_texture_table(std::span<const Texture> textures) {
  TextureTable table;
  const bool images = std::any_of(textures.begin(), textures.end(), [](const Texture& t) {
    return std::holds_alternative<BitmapTexture>(t);
  });
  const std::uint32_t linear = images ? add_decoding(table.texels, false) : 0;
  const std::uint32_t srgb = images ? add_decoding(table.texels, true) : 0;
  for (const Texture& texture : textures) {
    shared::TextureRecord record = pack_texture(texture);
    if (const auto* bitmap = std::get_if<BitmapTexture>(&texture)) {
      record.width = static_cast<std::uint32_t>(bitmap->width);
      record.height = static_cast<std::uint32_t>(bitmap->height);
      record.decoding = bitmap->colors.empty() ? (bitmap->srgb ? srgb : linear) : shared::NONE;
      record.first_texel = static_cast<std::uint32_t>(table.texels.size());
      table.texels.insert(table.texels.end(), bitmap->texels.begin(), bitmap->texels.end());
      for (const Color& color : bitmap->colors) {
        for (int c = 0; c < 3; ++c) table.texels.push_back(std::bit_cast<std::uint32_t>(color[c]));
      }
    }
    table.records.push_back(record);
  }
  return table;
}

}  // namespace facet
