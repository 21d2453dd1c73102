#include "scene/xml/document.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace facet {

XmlDocument::XmlDocument(std::filesystem::path path) : path_(std::move(path)) {
  std::ifstream in(path_, std::ios::binary);
  if (!in || std::filesystem::is_directory(path_)) {
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
}

int XmlDocument::line_at(std::ptrdiff_t offset) const {
  const auto after =
      std::upper_bound(line_starts_.begin(), line_starts_.end(), std::max<std::ptrdiff_t>(offset, 0));
  return static_cast<int>(after - line_starts_.begin());
}

SourceLocation XmlDocument::location(const pugi::xml_node& node) const {
  return {path_.string(), line_at(node.offset_debug())};
}

}  // namespace facet
