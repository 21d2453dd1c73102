#include <facet/scene.h>

#include "door/warnings.h"
#include "scene/reader.h"

namespace facet {

void tell_warnings(const Diagnostics& diagnostics, const LoadOptions& options) {
  if (!options.on_warning) return;
  for (const std::string& warning : diagnostics.warnings()) options.on_warning(warning);
}

ScenePtr load_scene(const std::filesystem::path& path, const LoadOptions& options) {
  Diagnostics diagnostics({options.strict, options.assets_below});
  auto scene = std::make_shared<const Scene>(read_scene(path, diagnostics));
  tell_warnings(diagnostics, options);
  return scene;
}

SceneSummary summarise(const Scene& scene) {
  SceneSummary s;
  s.file = scene.file.string();
  s.width = scene.camera.width;
  s.height = scene.camera.height;
  s.samples = scene.sample_count;
  s.integrator = scene.integrator.type.name;
  s.sampler = name_of(scene.sampler);
  s.triangles = scene.triangle_count();
  s.emitters = scene.emitters.size();
  return s;
}

}  // namespace facet
