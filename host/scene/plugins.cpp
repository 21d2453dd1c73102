#include "scene/plugins.h"

#include <algorithm>

#include "core/text.h"
#include "scene/integrator.h"
#include "scene/sampler.h"
#include "shared/bsdf_list.h"
#include "shared/emitter_list.h"

namespace facet {

namespace {

std::vector<PluginInfo> make_plugins() {
  std::vector<PluginInfo> list{
      {"mesh", "obj"},         {"camera", "perspective"}, {"rfilter", "gaussian"},
      {"rfilter", "mitchell"}, {"rfilter", "tent"},       {"rfilter", "box"},
      {"texture", "textmap"},  {"texture", "checker"},    {"test", "ttest"},
      {"test", "chi2test"},
  };
#define FACET_BSDF(name, Type, id) list.push_back({"bsdf", #name});
  FACET_BSDF_LIST(FACET_BSDF)
#undef FACET_BSDF
#define FACET_EMITTER(name, id) list.push_back({"emitter", #name});
  FACET_EMITTER_LIST(FACET_EMITTER)
#undef FACET_EMITTER
  for (const std::string_view name : sampler_names) list.push_back({"sampler", name});
  for (const IntegratorType& type : integrator_types()) list.push_back({"integrator", type.name});
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.tag < b.tag; });
  return list;
}

}  // namespace

const std::vector<PluginInfo>& plugins() {
  static const std::vector<PluginInfo> list = make_plugins();
  return list;
}

void fail_unknown_type(const PropertyReader& properties, const std::string& tag) {
  const std::string mend = did_you_mean(properties.type(), plugin_types(tag));
  throw InputError(properties.location(),
                   fmt::format("{} \"{}\": unknown type{}", tag, properties.type(), mend));
}

std::vector<std::string> plugin_types(std::string_view tag) {
  std::vector<std::string> types;
  for (const PluginInfo& plugin : plugins()) {
    if (plugin.tag == tag) types.emplace_back(plugin.type);
  }
  return types;
}

}  // namespace facet
