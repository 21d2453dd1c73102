#include "parity/suspects.h"

#include <fmt/format.h>

namespace facet::parity {

using reference::Part;

namespace {

std::string emitter_name(const Scene& scene, std::uint32_t i) {
  if (const auto* area = std::get_if<AreaEmitter>(&scene.emitters[i]))
    return fmt::format("emitter {} ({})", i, scene.meshes[area->mesh].name);
  const bool point = std::holds_alternative<PointLight>(scene.emitters[i]);
  return fmt::format("emitter {} ({})", i, point ? "point light" : "environment");
}

std::string part_name(const Scene& scene, const Feature& f) {
  switch (f.part) {
    case Part::mesh:
      return fmt::format("surface of {} (mesh {})", scene.meshes[f.index].name, f.index);
    case Part::vertex_normals:
      return "interpolated normals";
    case Part::texture:
      return fmt::format("texture {} ({})", f.index,
                         texture_type_names.at(scene.textures[f.index].index()));
    case Part::bsdf_eval:
      return fmt::format("value of {}", bsdf_type_names[f.index]);
    case Part::bsdf_sample:
      return fmt::format("sampling of {}", bsdf_type_names[f.index]);
    case Part::bsdf_pdf:
      return fmt::format("density of {} in MIS weights", bsdf_type_names[f.index]);
    case Part::emitter_sample:
      return fmt::format("sampling of {}", emitter_name(scene, f.index));
    case Part::emission_found:
      return fmt::format("{} found by a BSDF sample, its density", emitter_name(scene, f.index));
    case Part::emission_seen:
      return fmt::format("{} seen by the camera", emitter_name(scene, f.index));
    case Part::roulette:
      return "Russian roulette";
    case Part::blocked_shadow_ray:
      return "blocked shadow rays";
  }
  return "";
}

}  // namespace

void Spectrum::add(const std::vector<Feature>& features, bool failing) {
  ++(failing ? all_.failing : all_.passing);
  for (const Feature& f : features) ++(failing ? by_feature_[f].failing : by_feature_[f].passing);
}

void Spectrum::merge(const Spectrum& other) {
  all_.failing += other.all_.failing;
  all_.passing += other.all_.passing;
  for (const auto& [feature, counts] : other.by_feature_) {
    by_feature_[feature].failing += counts.failing;
    by_feature_[feature].passing += counts.passing;
  }
}

std::vector<Suspect> Spectrum::suspects(const Scene& scene) const {
  std::vector<Suspect> list;
  for (const auto& [feature, c] : by_feature_) {
    if (c.failing == 0) continue;
    const auto failing = static_cast<double>(c.failing);
    const double score = failing / std::sqrt(static_cast<double>(all_.failing) *
                                             (failing + static_cast<double>(c.passing)));
    list.push_back({part_name(scene, feature), score, c.failing, c.passing});
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Suspect& a, const Suspect& b) { return a.score > b.score; });
  return list;
}

}  // namespace facet::parity
