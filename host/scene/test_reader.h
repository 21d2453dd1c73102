#pragma once
// From a test file to a StatisticalTest.
#include "core/diagnostics.h"
#include "scene/test.h"

namespace facet {

/// Reads a <test> in Nori's language. Throws InputError with file and line for whatever is wrong.
[[nodiscard]] StatisticalTest read_test(const std::filesystem::path& path,
                                        Diagnostics& diagnostics);

}  // namespace facet
