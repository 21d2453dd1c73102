#pragma once
// Textures: colours over the (u, v) of a surface.
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/plugin/parameter.h"

namespace facet {

/* checker: cells of two colours.

   A cell is odd where one of floor(u scalex) and floor(v scaley) is odd, and the other is not. */
struct CheckerTexture {
  std::optional<Color> first{};
  std::optional<Color> second{};
  int scale_x = 1;
  int scale_y = 1;
  std::optional<Color> both{};

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    using namespace parameter;
    constexpr int most = 1 << 20;
    visit("scalex", p.scale_x, Count{1, most}, "cells per unit of u");
    visit("scaley", p.scale_y, Count{1, most}, "cells per unit of v");
    visit("color", p.both, NonNegativeColor{}, "colour of all cells");
    visit("color1", p.first, NonNegativeColor{}, "colour of even cells, 0.9 without `color`");
    visit("color2", p.second, NonNegativeColor{}, "colour of odd cells, 0.1 without `color`");
    visit.derived("even", p.even());
    visit.derived("odd", p.odd());
  }
  /// Colours of the cells.
  [[nodiscard]] Color even() const { return first.value_or(both.value_or(Color(0.9F))); }
  [[nodiscard]] Color odd() const { return second.value_or(both.value_or(Color(0.1F))); }
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
  std::string filename = {};       ///< as the scene says it; empty where a material does

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    using namespace parameter;
    constexpr double most = 1 << 20;
    visit("filename", p.filename, File{.required = true}, "relative to the scene file");
    visit("color", p.factor, NonNegativeColor{}, "factor on the image");
    visit("scalex", p.scale_x, Factor{most}, "images per unit of u");
    visit("scaley", p.scale_y, Factor{most}, "images per unit of v");
    visit("srgb", p.srgb, Switch{}, "decode sRGB; else a texel is its bytes over 255, as in Nori");
  }
};

// Every texture, once: X(name, Type). `name` is the scene language's type.
#define FACET_TEXTURE_LIST(X) \
  X(checker, CheckerTexture)  \
  X(textmap, BitmapTexture)

using Texture = std::variant<CheckerTexture, BitmapTexture>;

/// The scene language's types, in order of the variant's alternatives.
inline constexpr std::array texture_type_names{
#define FACET_TEXTURE_NAME(name, Type) std::string_view(#name),
    FACET_TEXTURE_LIST(FACET_TEXTURE_NAME)
#undef FACET_TEXTURE_NAME
};

/// What a byte of an image stands for: itself over 255, or decoded from sRGB (IEC 61966-2-1).
[[nodiscard]] const std::array<float, 256>& byte_values(bool srgb);

/// A texel of an image, decoded, without the image's factor.
[[nodiscard]] Color texel(const BitmapTexture& texture, std::size_t index);
/// Mean over the unit square, cell by cell or texel by texel.
[[nodiscard]] Color mean(const Texture& texture);
/// Largest value in any channel.
[[nodiscard]] float maximum(const Texture& texture);

}  // namespace facet
