#pragma once
// An XML file whose elements know their lines.
#include <filesystem>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "core/error.h"

namespace facet {

/// `bsdf "diffuse"`, or the tag alone without a type; for messages.
[[nodiscard]] std::string title_of(const pugi::xml_node& object);

class XmlDocument {
 public:
  /// Throws InputError, with the line, where the file is missing or not well-formed.
  explicit XmlDocument(std::filesystem::path path);
  /// From memory; messages name it by the path, and files are looked for beside it.
  XmlDocument(std::filesystem::path path, const std::string& bytes);

  [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }
  [[nodiscard]] SourceLocation location(const pugi::xml_node& node) const;
  /// Throws InputError at the first text among the children of an element: the language has none.
  void refuse_stray_content(const pugi::xml_node& parent) const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Notes the files that it names. Throws InputError where one must not be read.
  void add_inputs(Diagnostics& diagnostics) const;

 private:
  /// Throws InputError for what pugixml lets pass: an attribute that is given twice, an unknown
  /// entity.
  void check_attributes(const pugi::xml_node& element) const;
  [[nodiscard]] int line_at(std::ptrdiff_t offset) const;

  std::filesystem::path path_;
  std::string text_;  ///< in UTF-8
  std::vector<std::ptrdiff_t> line_starts_;
  pugi::xml_document document_;
};

}  // namespace facet
