// The values of PropertyReader: one function a type.
#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "scene/xml/property_reader.h"
#include "scene/xml/values.h"

namespace facet {

bool PropertyReader::boolean(const std::string& name, bool fallback) {
  const auto node = find(name, "boolean");
  if (!node) return fallback;
  const std::string text = required_word(xml_, *node);
  if (text != "true" && text != "false")
    fail(name, fmt::format("is \"{}\", but must be true or false", text));
  return text == "true";
}

vec3 PropertyReader::point(const std::string& name, const vec3& fallback) {
  const auto node = find(name, "point");
  if (!node) return fallback;
  const std::vector<double> v = read_numbers(xml_, *node, "value", 3, 3);
  const vec3 p(v[0], v[1], v[2]);
  if (!std::isfinite(p.x + p.y + p.z)) fail(name, "is too large");
  return p;
}

double PropertyReader::number(const std::string& name, double fallback) {
  const auto found = properties_.find(name);
  const bool whole =
      found != properties_.end() && std::string_view(found->second.name()) == "integer";
  return whole ? integer(name, 0, -(1 << 30), 1 << 30) : real(name, fallback);
}

double PropertyReader::real(const std::string& name, double fallback) {
  const auto node = find(name, "float");
  return node ? read_numbers(xml_, *node, "value", 1, 1)[0] : fallback;
}

void PropertyReader::require(bool condition, const std::string& name, double value,
                             const std::string& what) const {
  if (!condition) fail(name, fmt::format("is {:g}, but must {}", value, what));
}

double PropertyReader::real_inside(const std::string& name, double fallback, double least,
                                   double most) {
  const double value = real(name, fallback);
  require(value > least, name, value, fmt::format("be greater than {:g}", least));
  require(value < most, name, value, fmt::format("be less than {:g}", most));
  return value;
}

double PropertyReader::real_at_least(const std::string& name, double fallback, double bound) {
  const double value = real(name, fallback);
  require(value >= bound, name, value,
          bound == 0 ? "not be negative" : fmt::format("be at least {:g}", bound));
  return value;
}

double PropertyReader::real_between(const std::string& name, double fallback, double least,
                                    double most) {
  const double value = real(name, fallback);
  require(value >= least && value <= most, name, value,
          fmt::format("be {:g} to {:g}", least, most));
  return value;
}

double PropertyReader::number_within(const std::string& name, double fallback, double most) {
  const double value = number(name, fallback);
  require(std::abs(value) <= most, name, value, fmt::format("be {} to {}", -most, most));
  return value;
}

std::vector<double> PropertyReader::numbers(const std::string& name) {
  std::vector<double> numbers;
  const std::string text = string(name, "");
  for (const std::string_view part : split_list(text)) {
    const auto number = parse_real(part);
    if (!number) fail(name, fmt::format("holds \"{}\", which is no number", part));
    numbers.push_back(*number);
  }
  return numbers;
}

int PropertyReader::integer(const std::string& name, int fallback, int least, int most) {
  const auto node = find(name, "integer");
  if (!node) return fallback;
  const std::string text = required_word(xml_, *node);
  const std::optional<long long> value = parse_integer(text);
  if (!value) fail(name, fmt::format("is \"{}\", which is not an integer", text));
  if (*value < least || *value > most)
    fail(name, fmt::format("is {}, but must be {} to {}", *value, least, most));
  return static_cast<int>(*value);
}

std::string PropertyReader::string(const std::string& name, const std::string& fallback) {
  const auto node = find(name, "string");
  return node ? required_attribute(xml_, *node, "value") : fallback;
}

std::string PropertyReader::choice(const std::string& name, const std::vector<std::string>& words) {
  std::string word = string(name, words.front());
  if (std::find(words.begin(), words.end(), word) == words.end()) {
    fail(name, fmt::format("is \"{}\", which is none of: {}{}", word, fmt::join(words, ", "),
                           did_you_mean(word, words)));
  }
  return word;
}

Color PropertyReader::color(const std::string& name, const Color& fallback) {
  const auto node = find(name, "color");
  if (!node) return fallback;
  const std::vector<double> v = read_numbers(xml_, *node, "value", 1, 3);
  if (v.size() == 2) fail(name, "holds two numbers; one or three expected");
  const Color c = v.size() == 1 ? Color(static_cast<float>(v[0])) : Color(v[0], v[1], v[2]);
  if (!std::isfinite(c.r + c.g + c.b)) fail(name, "is too large");
  return c;
}

Color PropertyReader::reflectance(const std::string& name, const Color& fallback) {
  const Color c = color(name, fallback);
  if (glm::any(glm::lessThan(c, Color(0))) || glm::any(glm::greaterThan(c, Color(1)))) {
    fail(name, fmt::format("is ({:g}, {:g}, {:g}), but a reflectance lies between 0 and 1", c.r,
                           c.g, c.b));
  }
  return c;
}

Color PropertyReader::radiance(const std::string& name, const Color& fallback) {
  const Color c = color(name, fallback);
  if (glm::any(glm::greaterThan(c, Color(largest_radiance))))
    fail(name, fmt::format("is more than {:g}", largest_radiance));
  if (glm::any(glm::lessThan(c, Color(0))))
    fail(name, fmt::format("is ({:g}, {:g}, {:g}), but must not be negative", c.r, c.g, c.b));
  return c;
}

Color PropertyReader::color_between(const std::string& name, float least, float most) {
  const Color c = color(name, Color(least));
  if (glm::any(glm::lessThan(c, Color(least))) || glm::any(glm::greaterThan(c, Color(most)))) {
    fail(name, fmt::format("is ({:g}, {:g}, {:g}), but must be {:g} to {:g}", c.r, c.g, c.b, least,
                           most));
  }
  return c;
}

float PropertyReader::roughness(const std::string& name, float fallback) {
  const double alpha = real(name, fallback);
  if (alpha < least_roughness)
    fail(name, fmt::format("is {:g}, below 0.0001: such a surface is smooth; use the delta model "
                           "(mirror, dielectric)",
                           alpha));
  if (alpha > 1) fail(name, fmt::format("is {:g}, but roughness is at most 1", alpha));
  // The nearest float to 1e-4 lies below it.
  return static_cast<float>(alpha);
}

float PropertyReader::index_of_refraction(const std::string& name, float fallback) {
  return static_cast<float>(real_between(name, fallback, least_index, largest_index));
}

dmat4 PropertyReader::transform(const std::string& name) {
  const auto node = find(name, "transform");
  return node ? read_transform(xml_, *node) : dmat4(1);
}

}  // namespace facet
