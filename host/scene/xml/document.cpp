#include "scene/xml/document.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace facet {

std::string title_of(const pugi::xml_node& object) {
  const std::string type = object.attribute("type").value();
  return type.empty() ? std::string(object.name()) : fmt::format("{} \"{}\"", object.name(), type);
}

XmlDocument::XmlDocument(std::filesystem::path path) : path_(std::move(path)) {
  std::ifstream in(path_, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(path_)) {
    throw InputError(fmt::format("{}: cannot read the scene file", path_.string()));
  }
  std::ostringstream buffer;
  buffer << in.rdbuf();
  text_ = buffer.str();
  for (std::size_t i = 0; i <= text_.size(); ++i) {
    if (i == 0 || text_[i - 1] == '\n') line_starts_.push_back(static_cast<std::ptrdiff_t>(i));
  }
  const pugi::xml_parse_result result = document_.load_buffer(text_.data(), text_.size());
  if (!result) {
    throw InputError({path_.string(), line_at(result.offset)},
                     fmt::format("not well-formed XML: {}", result.description()));
  }
  for (const pugi::xml_node& child : document_.children()) {
    if (child.type() == pugi::node_element && child != root()) {
      throw InputError(location(child), fmt::format("a second root element <{}>", child.name()));
    }
  }
}

void XmlDocument::refuse_stray_content(const pugi::xml_node& parent) const {
  for (const pugi::xml_node& child : parent.children()) {
    if (child.type() != pugi::node_pcdata && child.type() != pugi::node_cdata) continue;
    std::string text = child.value();
    text.erase(0, text.find_first_not_of(" \t\r\n"));
    text = text.substr(0, text.find_first_of("\r\n"));
    throw InputError(location(child), fmt::format("stray text in {}: \"{}\"", title_of(parent), text));
  }
}

std::vector<std::filesystem::path> XmlDocument::files() const {
  std::vector<std::filesystem::path> files{path_};
  for (const pugi::xpath_node& name : document_.select_nodes("//string[@name='filename']"))
    files.push_back(path_.parent_path() / name.node().attribute("value").value());
  return files;
}

int XmlDocument::line_at(std::ptrdiff_t offset) const {
  const auto after =
      std::upper_bound(line_starts_.begin(), line_starts_.end(), std::max<std::ptrdiff_t>(offset, 0));
  return static_cast<int>(after - line_starts_.begin());
}

SourceLocation XmlDocument::location(const pugi::xml_node& node) const {
  std::ptrdiff_t offset = node.offset_debug();
  // Text begins where the tag before it ends, often lines above its first letter.
  if (node.type() == pugi::node_pcdata) {
    const std::size_t letter =
        text_.find_first_not_of(" \t\r\n", static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    if (letter != std::string::npos) offset = static_cast<std::ptrdiff_t>(letter);
  }
  return {path_.string(), line_at(offset)};
}

}  // namespace facet
