#pragma once
// Reads declared parameters (parameter.h) from the properties of an object in a scene file.
#include <algorithm>

#include "scene/plugin/parameter.h"
#include "scene/xml/property_reader.h"

namespace facet {

/// The visitor. Throws InputError at a property that is of another type or out of its range.
class ParameterReader {
 public:
  explicit ParameterReader(PropertyReader& properties) : properties_(properties) {}

  void operator()(const char* name, Textured<Color>& value, const parameter::Reflectance& kind,
                  const char* /*meaning*/) {
    value = properties_.textured_reflectance(name, value.value, kind.also_called);
  }
  void operator()(const char* name, Color& value, const parameter::Reflectance& /*kind*/,
                  const char* /*meaning*/) {
    value = properties_.reflectance(name, value);
  }
  void operator()(const char* name, Color& value, const parameter::NonNegativeColor& /*kind*/,
                  const char* /*meaning*/) {
    value = properties_.radiance(name, value);
  }
  void operator()(const char* name, Textured<Color>& value, const parameter::NonNegativeColor& kind,
                  const char* /*meaning*/) {
    const auto largest = static_cast<double>(largest_radiance);
    value.texture =
        properties_.texture(name, static_cast<float>(std::min(largest, largest / kind.scale)));
    if (!value.is_textured()) value.value = properties_.radiance(name, value.value);
  }
  void operator()(const char* name, std::optional<Color>& value,
                  const parameter::NonNegativeColor& /*kind*/, const char* /*meaning*/) {
    const Color color = properties_.radiance(name, Color(0));
    if (properties_.has(name)) value = color;
  }
  void operator()(const char* name, std::optional<Color>& value,
                  const parameter::ColorBetween& kind, const char* /*meaning*/) {
    const Color color = properties_.color_between(name, kind.least, kind.most);
    if (properties_.has(name)) value = color;
  }
  void operator()(const char* name, Textured<float>& value, const parameter::Roughness& /*kind*/,
                  const char* /*meaning*/) {
    value = properties_.textured_roughness(name, value.value);
  }
  void operator()(const char* name, float& value, const parameter::Roughness& /*kind*/,
                  const char* /*meaning*/) {
    value = properties_.roughness(name, value);
  }
  void operator()(const char* name, float& value, const parameter::RefractiveIndex& /*kind*/,
                  const char* /*meaning*/) {
    value = properties_.index_of_refraction(name, value);
  }
  template <typename Number>
  void operator()(const char* name, Number& value, const parameter::Between& kind,
                  const char* /*meaning*/) {
    value = static_cast<Number>(properties_.real_between(name, value, kind.least, kind.most));
  }
  void operator()(const char* name, double& value, const parameter::Scale& /*kind*/,
                  const char* /*meaning*/) {
    value = properties_.real_at_least(name, value, 0);
  }
  void operator()(const char* name, double& value, const parameter::AtLeast& kind,
                  const char* /*meaning*/) {
    value = properties_.real_at_least(name, value, kind.bound);
  }
  void operator()(const char* name, double& value, const parameter::Inside& kind,
                  const char* /*meaning*/) {
    value = properties_.real_inside(name, value, kind.least, kind.most);
  }
  void operator()(const char* name, double& value, const parameter::Real& /*kind*/,
                  const char* /*meaning*/) {
    value = properties_.real(name, value);
  }
  void operator()(const char* name, float& value, const parameter::Factor& kind,
                  const char* /*meaning*/) {
    value = static_cast<float>(properties_.number_within(name, value, kind.most));
  }
  template <typename Integer>
  void operator()(const char* name, Integer& value, const parameter::Count& kind,
                  const char* /*meaning*/) {
    value = static_cast<Integer>(
        properties_.integer(name, static_cast<int>(value), kind.least, kind.most));
  }
  void operator()(const char* name, bool& value, const parameter::Switch& /*kind*/,
                  const char* /*meaning*/) {
    value = properties_.boolean(name, value);
  }
  template <typename Value, typename Words>
  void operator()(const char* name, Value& value, const parameter::Choice<Words>& kind,
                  const char* /*meaning*/) {
    value = value_of(kind.words, properties_.choice(name, names_of(kind.words))).value();
  }
  void operator()(const char* name, std::string& value, const parameter::WordOf& kind,
                  const char* /*meaning*/) {
    value = properties_.string(name, "");
    if (properties_.has(name)) value = properties_.choice(name, kind.words);
  }
  void operator()(const char* name, std::string& value, const parameter::File& kind,
                  const char* /*meaning*/) {
    value = properties_.string(name, "");
    if (kind.required && value.empty()) properties_.fail(name, "is missing");
  }
  void operator()(const char* name, vec3& value, const parameter::Point& /*kind*/,
                  const char* /*meaning*/) {
    value = properties_.point(name, value);
  }
  void operator()(const char* name, dmat4& value, const parameter::Transform& /*kind*/,
                  const char* /*meaning*/) {
    value = properties_.transform(name);
  }
  void operator()(const char* name, std::vector<double>& value, const parameter::Numbers& /*kind*/,
                  const char* /*meaning*/) {
    value = properties_.numbers(name);
  }
  template <typename Value>
  void derived(const char* /*name*/, const Value& /*value*/) {}

 private:
  PropertyReader& properties_;
};

/// The parameters of an object whose plugin declares them in `Type`. Where parameters depend on
/// each other, `Type::check(properties)` throws at what is wrong, and completes what follows.
template <typename Type>
[[nodiscard]] Type read_parameters(PropertyReader& properties, Type value = {}) {
  ParameterReader reader(properties);
  Type::declare(value, reader);
  if constexpr (requires { value.check(properties); }) value.check(properties);
  return value;
}

}  // namespace facet
