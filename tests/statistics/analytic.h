#pragma once
// Scenes whose radiance is known.
#include "support/render.h"
#include "support/scenes.h"

namespace facet::test {

/// Tests of means in all files that include this, three channels each.
inline constexpr int case_count = 600;

inline void expect_radiance(Scene scene, const std::string& integrator, int spp,
                            const dvec3& expected) {
  SCOPED_TRACE(integrator);
  set_integrator(scene, integrator);
  expect_mean(render(scene, spp).image, Color(expected), critical_distance(case_count));
}

inline const std::vector<std::string>& all_estimators() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const IntegratorType& type : integrator_types()) {
      if (type.emitter_sampling || type.material_sampling) list.emplace_back(type.name);
    }
    return list;
  }();
  return names;
}

}  // namespace facet::test
