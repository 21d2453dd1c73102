// Materials of meshes.
#include "fuzz/target.h"
#include "scene/mesh/mtl.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace facet;
  const auto file = fuzz::workplace().write("fuzzed.mtl", fuzz::text_of(data, size));
  fuzz::expect_input_errors([&] {
    Diagnostics diagnostics(false);
    (void)read_mtl({"fuzzed.mtl"}, file.parent_path(), {"scene.xml", 1}, diagnostics);
  });
  return 0;
}
