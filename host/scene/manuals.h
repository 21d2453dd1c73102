#pragma once
// The plugins' manuals: their words, which the build takes from the heads of their files
// (cmake/generators/make_manuals.cpp), and their parameters, as they are declared.
#include <span>
#include <string>
#include <string_view>

namespace facet {

struct Manual {
  std::string_view kind;     ///< bsdf, emitter, ...
  std::string_view names;    ///< of the plugins it is about, with a blank before and after each
  std::string_view summary;  ///< one line
  std::string_view opening;  ///< first paragraph
  std::string_view details;  ///< all others; may be empty

  [[nodiscard]] bool is_about(std::string_view name) const {
    return names.find(' ' + std::string(name) + ' ') != std::string_view::npos;
  }
};

/// By kind and name.
[[nodiscard]] std::span<const Manual> manuals();

/// The opening, a table of the parameters, and the details: Markdown.
[[nodiscard]] std::string full_text(const Manual& manual);

}  // namespace facet
