#pragma once
// What a scene file says of an emitter, where more than that becomes of it (scene.h); manuals in
// shaders/emitter.
#include "scene/plugin/parameter.h"

namespace facet {

class PropertyReader;

struct AreaParameters {
  Textured<Color> radiance{Color(1)};
  double scale = 1;

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    visit("scale", p.scale, parameter::AtLeast{0}, "factor on the radiance");
    visit("radiance", p.radiance, parameter::NonNegativeColor{.scale = p.scale},
          "emitted radiance, W sr^-1 m^-2");
  }
  /// Throws InputError where the scale makes the radiance too large.
  void check(const PropertyReader& properties) const;
  /// Scale included; the factor on the texture where there is one.
  [[nodiscard]] Color scaled_radiance() const {
    return {dvec3(radiance.is_textured() ? Color(1) : radiance.value) * scale};
  }
};

/// What the values of an environment's image stand for.
enum class Encoding { msa, linear };
inline constexpr std::array encoding_words{Word{Encoding::msa, "msa"},
                                           Word{Encoding::linear, "linear"}};

struct EnvironmentParameters {
  std::string filename{};
  Color radiance{1};
  Encoding encoding = Encoding::msa;

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    using namespace parameter;
    visit("filename", p.filename, File{.required = false},
          "latitude-longitude image (EXR, HDR, or sRGB: PNG, JPEG); none: radiance alone");
    visit("radiance", p.radiance, NonNegativeColor{},
          "factor on the image, or the constant radiance");
    visit("encoding", p.encoding, Choice{encoding_words},
          "msa: the image is divided by 255; linear: it is taken as it is");
  }
};

}  // namespace facet
