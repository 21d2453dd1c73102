#include "scene/xml/values.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "core/text.h"

namespace facet {

std::string required_attribute(const XmlDocument& xml, const pugi::xml_node& node,
                               const char* name) {
  const pugi::xml_attribute attribute = node.attribute(name);
  if (!attribute) {
    throw InputError(xml.location(node),
                     fmt::format("<{}> lacks the attribute \"{}\"", node.name(), name));
  }
  return attribute.value();
}

std::string required_word(const XmlDocument& xml, const pugi::xml_node& node) {
  return std::string(trimmed(required_attribute(xml, node, "value")));
}

std::vector<double> read_numbers(const XmlDocument& xml, const pugi::xml_node& node,
                                 const char* attribute, std::size_t least, std::size_t most) {
  const std::string text = required_attribute(xml, node, attribute);
  std::vector<double> numbers;
  for (const std::string_view part : split_list(text)) {
    const std::optional<double> number = parse_real(part);
    if (!number)
      throw InputError(xml.location(node),
                       fmt::format("<{}>: \"{}\" is not a number", node.name(), part));
    numbers.push_back(*number);
  }
  if (numbers.size() < least || numbers.size() > most) {
    const std::string wanted =
        least == most ? fmt::format("{}", least) : fmt::format("{} or {}", least, most);
    throw InputError(xml.location(node),
                     fmt::format("<{}>: \"{}\" holds {} numbers; {} expected", node.name(),
                                 attribute, numbers.size(), wanted));
  }
  return numbers;
}

dvec3 read_vector(const XmlDocument& xml, const pugi::xml_node& node, const char* attribute) {
  const std::vector<double> v = read_numbers(xml, node, attribute, 3, 3);
  return {v[0], v[1], v[2]};
}

namespace {

dmat4 read_matrix(const XmlDocument& xml, const pugi::xml_node& node) {
  const std::vector<double> v = read_numbers(xml, node, "value", 16, 16);
  dmat4 m;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      m[column][row] = v[4 * static_cast<std::size_t>(row) + static_cast<std::size_t>(column)];
  }
  return m;
}

dmat4 read_scale(const XmlDocument& xml, const pugi::xml_node& node) {
  const std::vector<double> v = read_numbers(xml, node, "value", 1, 3);
  if (v.size() == 2)
    throw InputError(xml.location(node), "<scale>: one or three numbers expected, not two");
  return glm::scale(dmat4(1), v.size() == 1 ? dvec3(v[0]) : dvec3(v[0], v[1], v[2]));
}

/// Unit vector along v, whose square may over- or underflow; v is not zero.
dvec3 normalize_any(const dvec3& v) {
  return glm::normalize(v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}));
}

dmat4 read_rotate(const XmlDocument& xml, const pugi::xml_node& node) {
  const double angle = read_numbers(xml, node, "angle", 1, 1)[0];
  const dvec3 axis = read_vector(xml, node, "axis");
  if (axis == dvec3(0)) throw InputError(xml.location(node), "<rotate>: the axis has no direction");
  return glm::rotate(dmat4(1), glm::radians(angle), normalize_any(axis));
}

dmat4 read_lookat(const XmlDocument& xml, const pugi::xml_node& node) {
  const dvec3 origin = read_vector(xml, node, "origin");
  const dvec3 target = read_vector(xml, node, "target");
  const dvec3 up = read_vector(xml, node, "up");
  if (origin == target)
    throw InputError(xml.location(node), "<lookat>: origin and target are the same point");
  const dvec3 direction = normalize_any(target - origin);
  const dvec3 left = up == dvec3(0) ? up : glm::cross(normalize_any(up), direction);
  if (glm::length(left) <= 1e-12) {
    throw InputError(xml.location(node), "<lookat>: up is parallel to the direction of view");
  }
  const dvec3 unit_left = glm::normalize(left);
  return {glm::dvec4(unit_left, 0), glm::dvec4(glm::cross(direction, unit_left), 0),
          glm::dvec4(direction, 0), glm::dvec4(origin, 1)};
}

dmat4 read_step(const XmlDocument& xml, const pugi::xml_node& step) {
  xml.refuse_stray_content(step);
  for (const pugi::xml_node& child : step.children()) {
    if (child.type() == pugi::node_element)
      throw InputError(
          xml.location(child),
          fmt::format("<{}> inside the <{}> of a transform; steps stand one after another",
                      child.name(), step.name()));
  }
  const std::string_view name = step.name();
  if (name == "translate") return glm::translate(dmat4(1), read_vector(xml, step, "value"));
  if (name == "matrix") return read_matrix(xml, step);
  if (name == "rotate") return read_rotate(xml, step);
  if (name == "scale") return read_scale(xml, step);
  if (name == "lookat") return read_lookat(xml, step);
  const std::vector<std::string> known{"translate", "matrix", "rotate", "scale", "lookat"};
  throw InputError(xml.location(step), fmt::format("<{}> is not a step of a transform{}", name,
                                                   did_you_mean(name, known)));
}

}  // namespace

dmat4 read_transform(const XmlDocument& xml, const pugi::xml_node& node) {
  xml.refuse_stray_content(node);
  dmat4 m(1);
  for (const pugi::xml_node& step : node.children()) {
    if (step.type() == pugi::node_element) m = read_step(xml, step) * m;
  }
  return m;
}

}  // namespace facet
