// Meshes in OBJ.
#include "fuzz/target.h"
#include "scene/mesh/obj.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace facet;
  const auto file = fuzz::workplace().write("mesh.obj", fuzz::text_of(data, size));
  fuzz::expect_input_errors([&] {
    Diagnostics diagnostics(false);
    (void)read_obj(file, dmat4(1), {"scene.xml", 1}, diagnostics);
    (void)read_obj_by_material(file, dmat4(1), {"scene.xml", 1}, diagnostics);
  });
  return 0;
}
