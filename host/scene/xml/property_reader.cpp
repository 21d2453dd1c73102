#include "scene/xml/property_reader.h"

#include <algorithm>

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
