#include "scene/xml/property_reader.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/text.h"
#include "scene/xml/values.h"

namespace facet {

namespace {

const std::vector<std::string> object_tags{"scene",   "mesh",   "bsdf",       "texture",
                                           "emitter", "camera", "integrator", "sampler",
                                           "rfilter", "test",   "medium",     "phase"};
const std::vector<std::string> property_tags{"boolean", "integer", "float", "string",
                                             "point",   "vector",  "color", "transform"};

bool contains(const std::vector<std::string>& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

}  // namespace

PropertyReader::PropertyReader(const XmlDocument& xml, const pugi::xml_node& object,
                               TextureReader read_texture)
    : xml_(xml), object_(object), read_texture_(std::move(read_texture)) {
  xml.refuse_stray_content(object);
  for (const pugi::xml_node& child : object.children()) {
    if (child.type() != pugi::node_element) continue;
    const std::string tag = child.name();
    if (contains(object_tags, tag)) {
      if (tag == "medium" || tag == "phase") {
        throw InputError(xml.location(child),
                         fmt::format("<{}>: participating media are not supported", tag));
      }
      children_.push_back(child);
    } else if (contains(property_tags, tag)) {
      const std::string name = required_attribute(xml, child, "name");
      check_property(child);
      if (!properties_.emplace(name, child).second) {
        throw InputError(xml.location(child),
                         fmt::format("{}: property \"{}\" is given twice", title(), name));
      }
    } else {
      std::vector<std::string> known = object_tags;
      known.insert(known.end(), property_tags.begin(), property_tags.end());
      throw InputError(xml.location(child),
                       fmt::format("unknown tag <{}>{}", tag, did_you_mean(tag, known)));
    }
  }
}

void PropertyReader::check_property(const pugi::xml_node& property) const {
  if (std::string_view(property.name()) == "transform") return;  // read_transform looks into it
  xml_.refuse_stray_content(property);
  for (const pugi::xml_node& child : property.children()) {
    if (child.type() != pugi::node_element) continue;
    throw InputError(xml_.location(child),
                     fmt::format("<{}> inside the property \"{}\" of {}", child.name(),
                                 property.attribute("name").value(), title()));
  }
}

std::string PropertyReader::title() const { return title_of(object_); }

void PropertyReader::fail(const std::string& name, const std::string& message) const {
  const auto found = properties_.find(name);
  const SourceLocation where =
      found == properties_.end() ? location() : xml_.location(found->second);
  throw InputError(where, fmt::format("{}: \"{}\" {}", title(), name, message));
}

void PropertyReader::check_textures(const std::string& name) const {
  for (const pugi::xml_node& child : children_) {
    if (std::string_view(child.name()) != "texture" || child.attribute("name").value() != name)
      continue;
    throw InputError(
        xml_.location(child),
        texture_names_.contains(name)
            ? fmt::format("{}: \"{}\" is given as a property and as a texture", title(), name)
            : fmt::format("{}: \"{}\" cannot be a texture", title(), name));
  }
}

std::uint32_t PropertyReader::texture(const std::string& name, float most) {
  known_tags_.insert("texture");
  texture_names_.insert(name);
  std::uint32_t index = none;
  for (const pugi::xml_node& child : children_) {
    if (std::string_view(child.name()) != "texture" || child.attribute("name").value() != name)
      continue;
    if (index != none)
      throw InputError(xml_.location(child),
                       fmt::format("{}: texture \"{}\" is given twice", title(), name));
    if (has(name)) check_textures(name);
    index = read_texture_(child, most);
  }
  return index;
}

Textured<Color> PropertyReader::textured_reflectance(const std::string& name, const Color& fallback,
                                                     const std::string& also_called) {
  Textured<Color> parameter(fallback);
  parameter.texture = texture(name, 1);
  const std::uint32_t other = also_called.empty() ? none : texture(also_called, 1);
  if (other != none && (parameter.is_textured() || has(name)))
    fail(name, fmt::format("is given, and \"{}\", which is another name for it", also_called));
  if (other != none) parameter.texture = other;
  if (!parameter.is_textured()) parameter.value = reflectance(name, fallback);
  return parameter;
}

Textured<float> PropertyReader::textured_roughness(const std::string& name, float fallback) {
  Textured<float> parameter(fallback);
  parameter.texture = texture(name, 1);
  if (!parameter.is_textured()) parameter.value = roughness(name, fallback);
  return parameter;
}

std::optional<pugi::xml_node> PropertyReader::find(const std::string& name,
                                                   const std::string& tag) {
  known_names_.insert(name);
  check_textures(name);
  const auto found = properties_.find(name);
  if (found == properties_.end()) return std::nullopt;
  if (found->second.name() != tag)
    fail(name, fmt::format("must be a <{}>, not a <{}>", tag, found->second.name()));
  return found->second;
}

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

double PropertyReader::real_above(const std::string& name, double fallback, double bound) {
  const double value = real(name, fallback);
  if (!(value > bound))
    fail(name, fmt::format("is {:g}, but must be greater than {:g}", value, bound));
  return value;
}

double PropertyReader::real_between(const std::string& name, double fallback, double least,
                                    double most) {
  const double value = real(name, fallback);
  if (!(value >= least && value <= most))
    fail(name, fmt::format("is {:g}, but must be {:g} to {:g}", value, least, most));
  return value;
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
  if (!contains(words, word)) {
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
  if (alpha < 1e-4)
    fail(name, fmt::format("is {:g}, below 0.0001: such a surface is smooth; use the delta model "
                           "(mirror, dielectric)",
                           alpha));
  if (alpha > 1) fail(name, fmt::format("is {:g}, but roughness is at most 1", alpha));
  // The nearest float to 1e-4 lies below it.
  return static_cast<float>(alpha);
}

float PropertyReader::index_of_refraction(const std::string& name, float fallback) {
  return static_cast<float>(real_between(name, fallback, 0.001, 1000));
}

dmat4 PropertyReader::transform(const std::string& name) {
  const auto node = find(name, "transform");
  return node ? read_transform(xml_, *node) : dmat4(1);
}

std::vector<pugi::xml_node> PropertyReader::children(const std::string& tag) {
  known_tags_.insert(tag);
  std::vector<pugi::xml_node> found;
  std::copy_if(children_.begin(), children_.end(), std::back_inserter(found),
               [&](const pugi::xml_node& child) { return child.name() == tag; });
  return found;
}

std::optional<pugi::xml_node> PropertyReader::only_child(const std::string& tag) {
  const std::vector<pugi::xml_node> found = children(tag);
  if (found.size() > 1)
    throw InputError(xml_.location(found[1]),
                     fmt::format("{} has more than one <{}>", title(), tag));
  return found.empty() ? std::nullopt : std::optional(found.front());
}

void PropertyReader::finish(Diagnostics& diagnostics) {
  for (const pugi::xml_node& child : children_) {
    if (known_tags_.contains(child.name())) continue;
    throw InputError(xml_.location(child),
                     fmt::format("{} cannot hold a <{}>", title(), child.name()));
  }
  const std::vector<std::string> textures(texture_names_.begin(), texture_names_.end());
  for (const pugi::xml_node& child : children_) {
    const std::string name = child.attribute("name").value();
    if (std::string_view(child.name()) != "texture" || texture_names_.contains(name)) continue;
    throw InputError(xml_.location(child),
                     fmt::format("{} has no parameter \"{}\" for a texture{}", title(), name,
                                 did_you_mean(name, textures)));
  }
  std::set<std::string> known = known_names_;
  known.insert(texture_names_.begin(), texture_names_.end());
  const std::vector<std::string> names(known.begin(), known.end());
  for (const auto& [name, node] : properties_) {
    if (known_names_.contains(name)) continue;
    diagnostics.warn(xml_.location(node), fmt::format("{}: unknown property \"{}\" is ignored{}",
                                                      title(), name, did_you_mean(name, names)));
  }
}

}  // namespace facet
