// Nori's tests in XML.
#include "fuzz/target.h"
#include "scene/test_reader.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace facet;
  const auto file = fuzz::workplace().write("test.xml", fuzz::text_of(data, size));
  fuzz::expect_input_errors([&] {
    Diagnostics diagnostics(false);
    (void)read_test(file, diagnostics);
  });
  return 0;
}
