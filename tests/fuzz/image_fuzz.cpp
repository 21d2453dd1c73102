// Images of all kinds, as their first bytes tell: EXR, PNG, JPEG, HDR.
#include "fuzz/target.h"
#include "image/files.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace facet;
  const auto file = fuzz::workplace().write("image", fuzz::text_of(data, size));
  fuzz::expect_input_errors([&] { (void)read_image(file); });
  return 0;
}
