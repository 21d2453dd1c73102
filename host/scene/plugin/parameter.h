#pragma once
// How a plugin declares its parameters. Once, in a function that takes any visitor:
//
//     template <typename Self, typename Visitor>
//     static void declare(Self& p, Visitor& visit) {
//       visit("kd", p.kd, Reflectance{}, "albedo of the base");
//       visit("alpha", p.alpha, Roughness{}, "roughness of the coat");
//     }
//
// The name is the scene language's, the member's value in a new object is the default, the kind
// says which values it may have. Visitors read parameters from a file (parameter_reader.h), list
// them for manuals (parameter_list.h), hash them (fingerprint.cpp), put them into the kernels'
// records and name them in GLSL (render/pack/record_layout.h), and vary them in tests.
//
// `visit.derived(name, value)` declares what the kernels read beside the parameters because it is
// computed from them.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/maths.h"
#include "core/words.h"
#include "scene/texture/textured.h"

namespace facet::parameter {

/// The words in a list, for a manual.
[[nodiscard]] std::string one_of(const std::vector<std::string>& words);

// The kinds. Each has a type, and a range in words, empty where the type says all.

/// A colour in [0, 1], or a texture of such.
struct Reflectance {
  static constexpr const char* type = "colour";
  const char* also_called = "";  ///< another name for the parameter
  [[nodiscard]] std::string range() const;
};

/// A colour that is not negative, nor larger than `largest_radiance`, or a texture of such.
struct NonNegativeColor {
  static constexpr const char* type = "colour";
  double scale = 1;  ///< a factor (Scale), with which it must not be larger either
  [[nodiscard]] std::string range() const;
  /// The colour with the factor; the factor alone where a texture gives the colour.
  [[nodiscard]] Textured<Color> scaled(const Textured<Color>& color) const {
    Textured<Color> result(Color(dvec3(color.is_textured() ? Color(1) : color.value) * scale));
    result.texture = color.texture;
    return result;
  }
};

/// A factor, not negative, on a colour that is declared with it.
struct Scale {
  static constexpr const char* type = "number";
  [[nodiscard]] static std::string range() { return "at least 0"; }
};

/// An optional colour, every channel within bounds.
struct ColorBetween {
  static constexpr const char* type = "colour";
  float least;
  float most;
  [[nodiscard]] std::string range() const;
};

/// Beckmann or GGX alpha, 1e-4 to 1, or a texture of such.
struct Roughness {
  static constexpr const char* type = "number";
  [[nodiscard]] std::string range() const;
};

/// A positive index of refraction.
struct RefractiveIndex {
  static constexpr const char* type = "number";
  [[nodiscard]] std::string range() const;
};

/// A number within bounds, themselves included.
struct Between {
  static constexpr const char* type = "number";
  double least;
  double most;
  [[nodiscard]] std::string range() const;
};

/// A number that is not below a bound.
struct AtLeast {
  static constexpr const char* type = "number";
  double bound;
  [[nodiscard]] std::string range() const;
};

/// A number between bounds, themselves excluded.
struct Inside {
  static constexpr const char* type = "number";
  double least;
  double most;
  [[nodiscard]] std::string range() const;
};

/// A number whose bound depends on other parameters: the plugin checks it.
struct Real {
  static constexpr const char* type = "number";
  [[nodiscard]] static std::string range() { return ""; }
};

/// A number, which may be written as an <integer>, of magnitude up to `most`.
struct Factor {
  static constexpr const char* type = "number";
  double most;
  [[nodiscard]] std::string range() const;
};

/// An integer within bounds.
struct Count {
  static constexpr const char* type = "integer";
  int least;
  int most;
  [[nodiscard]] std::string range() const;
};

/// True or false. flag: of a BSDF's record (shared/records.h), set where true.
struct Switch {
  static constexpr const char* type = "boolean";
  std::uint32_t flag = 0;
  [[nodiscard]] static std::string range() { return ""; }
};

/// One of the words for an enumeration's values (core/words.h), the first being the default. flag:
/// of a BSDF's record, set for the second of two.
template <typename Words>
struct Choice {
  static constexpr const char* type = "string";
  const Words& words;
  std::uint32_t flag = 0;
  [[nodiscard]] std::string range() const { return one_of(names_of(words)); }
};
template <typename Words>
Choice(const Words&, std::uint32_t = 0) -> Choice<Words>;

/// A word from a list, or none.
struct WordOf {
  static constexpr const char* type = "string";
  const std::vector<std::string>& words;
  [[nodiscard]] std::string range() const { return one_of(words); }
};

/// A file's name, relative to the scene file.
struct File {
  static constexpr const char* type = "file";
  bool required;
  [[nodiscard]] static std::string range() { return ""; }
};

/// A point in the scene's space.
struct Point {
  static constexpr const char* type = "point";
  [[nodiscard]] static std::string range() { return ""; }
};

/// A transform to the scene's space.
struct Transform {
  static constexpr const char* type = "transform";
  [[nodiscard]] static std::string range() { return ""; }
};

/// A list of numbers in a <string>, between commas and blanks.
struct Numbers {
  static constexpr const char* type = "numbers in a string";
  [[nodiscard]] static std::string range() { return ""; }
};

}  // namespace facet::parameter
