#pragma once
// Textures: colours over the (u, v) of a surface.
#include <array>
#include <variant>
#include <vector>

#include "core/maths.h"

namespace facet {

/* checker: cells of two colours.

   A cell is odd where one of floor(u scalex) and floor(v scaley) is odd, and the other is not. */
struct CheckerTexture {
  Color first{0.9F};
  Color second{0.1F};
  int scale_x = 1;
  int scale_y = 1;
};

/* textmap: an image (PNG, JPEG, OpenEXR or Radiance HDR, told apart by its bytes), bilinear,
   repeating.

   Samples of 16 bits are taken over 65535; OpenEXR and HDR hold values, which are taken as they
   are. (u, v) looks up texel ((1 - u) W, (1 - v) H), row 0 being the top one. */
struct BitmapTexture {
  int width = 1;
  int height = 1;
  std::vector<std::uint32_t>
      texels;         ///< 0x00bbggrr, rows from the top; empty where there are `colors`
  bool srgb = false;  ///< of texels
  Color factor{1};
  float scale_x = 1;
  float scale_y = 1;
  std::vector<Color> colors = {};  ///< texels of more than 8 bits a channel, decoded
};

using Texture = std::variant<CheckerTexture, BitmapTexture>;

/// What a byte of an image stands for: itself over 255, or decoded from sRGB (IEC 61966-2-1).
[[nodiscard]] const std::array<float, 256>& byte_values(bool srgb);

/// A texel of an image, decoded, without the image's factor.
[[nodiscard]] Color texel(const BitmapTexture& texture, std::size_t index);
/// Mean over the unit square, cell by cell or texel by texel.
[[nodiscard]] Color mean(const Texture& texture);
/// Largest value in any channel.
[[nodiscard]] float maximum(const Texture& texture);

}  // namespace facet
