#pragma once
// The properties and children of one object tag, handed out by name and type. What nobody asked for
// draws a warning.
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "core/maths.h"
#include "scene/texture/textured.h"
#include "scene/xml/document.h"

namespace facet {

/// Radiances beyond this would overflow on their way to the film.
inline constexpr float largest_radiance = 1e30F;
/// Below it a surface is as good as smooth, which is a model of its own.
inline constexpr double least_roughness = 1e-4;
/// Of an index of refraction.
inline constexpr double least_index = 0.001;
inline constexpr double largest_index = 1000;

/// Reads a <texture> into the scene; returns its index. Throws InputError where a value lies beyond
/// `most`.
using TextureReader = std::function<std::uint32_t(const pugi::xml_node& texture, float most)>;

class PropertyReader {
 public:
  /// Throws InputError for tags that are no part of the language. read_texture: for objects whose
  /// parameters may be textures.
  PropertyReader(const XmlDocument& xml, const pugi::xml_node& object,
                 TextureReader read_texture = {});

  [[nodiscard]] SourceLocation location() const { return xml_.location(object_); }
  [[nodiscard]] const XmlDocument& xml() const { return xml_; }
  /// `bsdf "diffuse"`, for messages.
  [[nodiscard]] std::string title() const;
  [[nodiscard]] std::string type() const { return object_.attribute("type").value(); }
  /// Whether the object has a property of that name.
  [[nodiscard]] bool has(const std::string& name) const { return properties_.contains(name); }

  // Each returns the property, or the default where the object has none of that name. A property of
  // another type, or out of the stated range, is an error.
  bool boolean(const std::string& name, bool fallback);
  double real(const std::string& name, double fallback);
  /// A <float> or an <integer>.
  double number(const std::string& name, double fallback);
  vec3 point(const std::string& name, const vec3& fallback);
  int integer(const std::string& name, int fallback, int least, int most);
  std::string string(const std::string& name, const std::string& fallback);
  Color color(const std::string& name, const Color& fallback);
  dmat4 transform(const std::string& name);
  /// A colour in [0, 1].
  Color reflectance(const std::string& name, const Color& fallback);
  /// A colour that is nowhere negative, nor larger than largest_radiance.
  Color radiance(const std::string& name, const Color& fallback);
  /// A colour, every channel within bounds; `least` where the object has none.
  Color color_between(const std::string& name, float least, float most);
  /// Beckmann or GGX alpha, 1e-4 to 1.
  float roughness(const std::string& name, float fallback);
  /// The same from a texture where the object has one of that name, or of the other name, by which
  /// the lab calls it.
  Textured<Color> textured_reflectance(const std::string& name, const Color& fallback,
                                       const std::string& also_called = "");
  Textured<float> textured_roughness(const std::string& name, float fallback);
  /// The texture of that name, or none; an error where there is a property of that name, too.
  std::uint32_t texture(const std::string& name, float most);
  /// A positive index of refraction.
  float index_of_refraction(const std::string& name, float fallback);
  /// One of the words.
  std::string choice(const std::string& name, const std::vector<std::string>& words);
  /// real() within bounds, themselves included.
  double real_between(const std::string& name, double fallback, double least, double most);
  /// real() within bounds, themselves excluded.
  double real_inside(const std::string& name, double fallback, double least, double most);
  /// real() not below a bound.
  double real_at_least(const std::string& name, double fallback, double bound);
  /// number() of a magnitude up to `most`.
  double number_within(const std::string& name, double fallback, double most);
  /// A <string> of numbers between commas and blanks; empty where the object has none.
  std::vector<double> numbers(const std::string& name);

  /// Child objects with this tag, in order.
  std::vector<pugi::xml_node> children(const std::string& tag);
  /// The only such child; an error if there are two.
  std::optional<pugi::xml_node> only_child(const std::string& tag);

  /// To be called when everything was asked for: children that cannot stand here are errors,
  /// properties that nobody knows are warnings.
  void finish(Diagnostics& diagnostics);

  /// Throws InputError at the property (or at the object, where it has none of that name).
  [[noreturn]] void fail(const std::string& name, const std::string& message) const;

 private:
  /// The property's node if it is there; an error if its tag is not the given one.
  std::optional<pugi::xml_node> find(const std::string& name, const std::string& tag);
  /// Throws InputError, with the value and what it must do, unless the condition holds.
  void require(bool condition, const std::string& name, double value,
               const std::string& what) const;
  void check_property(const pugi::xml_node& property) const;
  /// A property that is given as a texture, too, or only could be one elsewhere, is an error.
  void check_textures(const std::string& name) const;

  const XmlDocument& xml_;
  pugi::xml_node object_;
  TextureReader read_texture_;
  std::set<std::string> texture_names_;
  std::map<std::string, pugi::xml_node> properties_;
  std::vector<pugi::xml_node> children_;
  std::set<std::string> known_names_;
  std::set<std::string> known_tags_;
};

}  // namespace facet
