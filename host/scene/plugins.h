#pragma once
// Every plugin of the scene language, and which of them this version has.
#include <string>
#include <string_view>
#include <vector>

namespace facet {

struct PluginInfo {
  std::string_view tag;   ///< mesh, bsdf, ...
  std::string_view type;  ///< the XML attribute
  bool supported;
};

[[nodiscard]] const std::vector<PluginInfo>& plugins();

/// Types of a tag, supported or not.
[[nodiscard]] std::vector<std::string> plugin_types(std::string_view tag);

}  // namespace facet
