#include "scene/xml/document.h"

#include <algorithm>
#include <set>

#include "core/input_file.h"
#include "scene/xml/encoding.h"

namespace facet {

std::string title_of(const pugi::xml_node& object) {
  const std::string type = object.attribute("type").value();
  return type.empty() ? std::string(object.name()) : fmt::format("{} \"{}\"", object.name(), type);
}

XmlDocument::XmlDocument(std::filesystem::path path) : XmlDocument(path, read_input_file(path)) {}

XmlDocument::XmlDocument(std::filesystem::path path, const std::string& bytes)
    : path_(std::move(path)), text_(to_utf8(bytes)) {
  for (std::size_t i = 0; i <= text_.size(); ++i) {
    if (i == 0 || text_[i - 1] == '\n') line_starts_.push_back(static_cast<std::ptrdiff_t>(i));
  }
  const pugi::xml_parse_result result =
      document_.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!result) {
    const auto foreign = recognise_foreign_file(text_, "a scene in XML");
    throw InputError({path_.string(), line_at(result.offset)},
                     fmt::format("not well-formed XML: {}{}", result.description(),
                                 foreign ? "; " + *foreign : ""));
  }
  struct Walker : pugi::xml_tree_walker {
    explicit Walker(const XmlDocument& document) : xml(document) {}
    bool for_each(pugi::xml_node& node) override {
      xml.check_attributes(node);
      return true;
    }
    const XmlDocument& xml;
  } walker(*this);
  document_.traverse(walker);
  for (const pugi::xml_node& child : document_.children()) {
    if (child.type() == pugi::node_element && child != root()) {
      throw InputError(location(child), fmt::format("a second root element <{}>", child.name()));
    }
  }
}

void XmlDocument::check_attributes(const pugi::xml_node& element) const {
  std::set<std::string_view> names;
  for (const pugi::xml_attribute& attribute : element.attributes()) {
    if (!names.insert(attribute.name()).second)
      throw InputError(location(element),
                       fmt::format("not well-formed XML: <{}> has the attribute \"{}\" twice",
                                   element.name(), attribute.name()));
    const std::string_view value = attribute.value();
    const std::size_t begin = std::min(value.find('&'), value.size());
    const std::size_t end = value.find(';', begin);
    if (end == std::string_view::npos) continue;
    // "&amp;name;" has the same value, but is another text.
    const std::string_view entity = value.substr(begin, end + 1 - begin);
    if (text_.find(entity) != std::string::npos)
      throw InputError(
          location(element),
          fmt::format("the entity {} is unknown; there are &amp; &lt; &gt; &quot; "
                      "&apos; and numbers, and entities of one's own are not supported",
                      entity));
  }
}

void XmlDocument::refuse_stray_content(const pugi::xml_node& parent) const {
  for (const pugi::xml_node& child : parent.children()) {
    if (child.type() != pugi::node_pcdata && child.type() != pugi::node_cdata) continue;
    std::string text = child.value();
    text.erase(0, text.find_first_not_of(" \t\r\n"));
    text = text.substr(0, text.find_first_of("\r\n"));
    throw InputError(location(child),
                     fmt::format("stray text in {}: \"{}\"", title_of(parent), text));
  }
}

void XmlDocument::add_inputs(Diagnostics& diagnostics) const {
  for (const pugi::xpath_node& name : document_.select_nodes("//string[@name='filename']"))
    diagnostics.add_input(location(name.node()),
                          path_.parent_path() / name.node().attribute("value").value());
}

int XmlDocument::line_at(std::ptrdiff_t offset) const {
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(),
                                      std::max<std::ptrdiff_t>(offset, 0));
  return static_cast<int>(after - line_starts_.begin());
}

SourceLocation XmlDocument::location(const pugi::xml_node& node) const {
  std::ptrdiff_t offset = node.offset_debug();
  // Text begins where the tag before it ends, often lines above its first letter.
  if (node.type() == pugi::node_pcdata) {
    const std::size_t letter = text_.find_first_not_of(
        " \t\r\n", static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    if (letter != std::string::npos) offset = static_cast<std::ptrdiff_t>(letter);
  }
  return {path_.string(), line_at(offset)};
}

}  // namespace facet
