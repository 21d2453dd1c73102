// The whole way to what is uploaded: a scene, and after a zero byte its mesh.
#include "door/warnings.h"
#include "fuzz/target.h"
#include "render/pack/packed_scene.h"
#include "scene/reader.h"
#include "scene/settings.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace facet;
  const std::string_view input = fuzz::text_of(data, size);
  const std::size_t end = std::min(input.find('\0'), input.size());
  const auto file = fuzz::workplace().write("scene.xml", input.substr(0, end));
  (void)fuzz::workplace().write("square.obj", input.substr(std::min(end + 1, input.size())));
  fuzz::expect_input_errors([&] {
    Diagnostics diagnostics(false);
    const Scene scene = read_scene(file, diagnostics);
    const RenderSettings settings = resolve(scene, {.integrator = "path_mis"});
    warn_about_render(scene, settings, diagnostics);
    (void)pack_scene(scene, settings);
  });
  return 0;
}
