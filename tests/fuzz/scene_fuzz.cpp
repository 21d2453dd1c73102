// Scenes in XML; the files that they may refer to are good ones.
#include "fuzz/target.h"
#include "scene/reader.h"
#include "scene/settings.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace facet;
  const auto file = fuzz::workplace().write("scene.xml", fuzz::text_of(data, size));
  fuzz::expect_input_errors([&] {
    Diagnostics diagnostics(false);
    const Scene scene = read_scene(file, diagnostics);
    (void)resolve(scene, {.integrator = "path_mis"});
  });
  return 0;
}
