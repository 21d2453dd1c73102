#include "scene/integrator.h"

#include <algorithm>

namespace facet {

namespace {

enum KernelId : int {
#define FACET_ID(name, id) kernel_##name = id,
  FACET_INTEGRATOR_KERNEL_LIST(FACET_ID)
#undef FACET_ID
};

}  // namespace

const std::vector<IntegratorType>& integrator_types() {
  static const std::vector<IntegratorType> types{
#define FACET_TYPE(name, kernel, ems, mats, interactions) \
  {#name, kernel_##kernel, (ems) != 0, (ems) == 2, (mats) != 0, interactions},
      FACET_INTEGRATOR_LIST(FACET_TYPE)
#undef FACET_TYPE
  };
  return types;
}

std::optional<IntegratorType> find_integrator_type(std::string_view name) {
  const auto& types = integrator_types();
  const auto found = std::find_if(types.begin(), types.end(),
                                  [&](const IntegratorType& t) { return t.name == name; });
  return found == types.end() ? std::nullopt : std::optional(*found);
}

}  // namespace facet
