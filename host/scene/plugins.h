#pragma once
// Every plugin of the scene language, and which of them this version has.
#include <string>
#include <string_view>
#include <vector>

#include "scene/xml/property_reader.h"

namespace facet {

struct PluginInfo {
  std::string_view tag;   ///< mesh, bsdf, ...
  std::string_view type;  ///< the XML attribute
  bool supported;
};

[[nodiscard]] const std::vector<PluginInfo>& plugins();

/// Ends reading at a plugin that does not exist, or not yet.
[[noreturn]] void fail_unknown_type(const PropertyReader& properties, const std::string& tag);

/// Types of a tag, supported or not.
[[nodiscard]] std::vector<std::string> plugin_types(std::string_view tag);

}  // namespace facet
