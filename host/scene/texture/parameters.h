#pragma once
// What a scene file says of a texture; manuals in texture.h.
#include <optional>

#include "scene/plugin/parameter.h"

namespace facet {

struct CheckerParameters {
  std::optional<Color> both{};
  std::optional<Color> first{};
  std::optional<Color> second{};
  int scale_x = 1;
  int scale_y = 1;

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    using namespace parameter;
    constexpr int most = 1 << 20;
    visit("scalex", p.scale_x, Count{1, most}, "cells per unit of u");
    visit("scaley", p.scale_y, Count{1, most}, "cells per unit of v");
    visit("color", p.both, NonNegativeColor{}, "colour of all cells");
    visit("color1", p.first, NonNegativeColor{}, "colour of even cells, 0.9 without `color`");
    visit("color2", p.second, NonNegativeColor{}, "colour of odd cells, 0.1 without `color`");
  }
};

struct TextmapParameters {
  std::string filename{};
  Color factor{1};
  float scale_x = 1;
  float scale_y = 1;
  bool srgb = false;

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

}  // namespace facet
