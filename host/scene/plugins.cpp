#include "scene/plugins.h"

#include <algorithm>

#include "core/text.h"
#include "scene/emitter/environment.h"
#include "scene/manuals.h"
#include "scene/mesh/obj.h"
#include "scene/test.h"
#include "scene/texture/texture.h"
#include "shared/emitter_list.h"

namespace facet {

namespace {

/// The parameters of each emitter of the shared list.
struct EmitterDeclarations {
  AreaEmitter area;
  EnvironmentParameters environment;
  PointLight pointlight;
};

std::vector<PluginInfo> make_plugins() {
  std::vector<PluginInfo> list{
      {"mesh", "obj", list_parameters<ObjParameters>()},
      {"camera", "perspective", list_parameters<Camera>()},
      {"rfilter", "gaussian", list_parameters<GaussianFilter>()},
      {"rfilter", "mitchell", list_parameters<MitchellFilter>()},
      {"rfilter", "tent", list_parameters<TentFilter>()},
      {"rfilter", "box", list_parameters<BoxFilter>()},
      {"test", "ttest", list_parameters<TTest>()},
      {"test", "chi2test", list_parameters<ChiSquaredTest>()},
  };
#define FACET_BSDF(name, Type, id) list.push_back({"bsdf", #name, list_parameters<bsdf::Type>()});
  FACET_BSDF_LIST(FACET_BSDF)
#undef FACET_BSDF
#define FACET_TEXTURE(name, Type) list.push_back({"texture", #name, list_parameters<Type>()});
  FACET_TEXTURE_LIST(FACET_TEXTURE)
#undef FACET_TEXTURE
  const EmitterDeclarations emitters;
#define FACET_EMITTER(name, id) list.push_back({"emitter", #name, list_parameters(emitters.name)});
  FACET_EMITTER_LIST(FACET_EMITTER)
#undef FACET_EMITTER
  for (const std::string_view name : sampler_names)
    list.push_back({"sampler", name, list_parameters<SamplerParameters>()});
  for (const IntegratorType& type : integrator_types())
    list.push_back({"integrator", type.name, list_parameters(Integrator{type})});
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

std::string full_text(const Manual& manual) {
  const auto plugin = std::find_if(plugins().begin(), plugins().end(), [&](const PluginInfo& p) {
    return p.tag == manual.kind && manual.is_about(p.type);
  });
  std::string text(manual.opening);
  if (plugin != plugins().end()) text += table_of(plugin->parameters);
  if (!manual.details.empty()) text += "\n" + std::string(manual.details);
  return text;
}

std::vector<std::string> plugin_types(std::string_view tag) {
  std::vector<std::string> types;
  for (const PluginInfo& plugin : plugins()) {
    if (plugin.tag == tag) types.emplace_back(plugin.type);
  }
  return types;
}

}  // namespace facet
