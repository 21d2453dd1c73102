#pragma once
// Every plugin of the scene language.
#include <string>
#include <string_view>
#include <vector>

#include "scene/plugin/parameter_list.h"
#include "scene/xml/property_reader.h"

namespace facet {

struct PluginInfo {
  std::string_view tag;   ///< mesh, bsdf, ...
  std::string_view type;  ///< the XML attribute
  std::vector<ParameterInfo> parameters;
};

[[nodiscard]] const std::vector<PluginInfo>& plugins();

/// Ends reading at a plugin that does not exist.
[[noreturn]] void fail_unknown_type(const PropertyReader& properties, const std::string& tag);

/// Types of a tag.
[[nodiscard]] std::vector<std::string> plugin_types(std::string_view tag);

}  // namespace facet
