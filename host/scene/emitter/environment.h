#pragma once
// What a scene file says of an environment, of which an EnvironmentEmitter (scene.h) is made;
// manual in shaders/emitter/environment.glsl.
#include "scene/plugin/parameter.h"

namespace facet {

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
