#pragma once
// Backends by their options.
#include "scene/testable_backend.h"

namespace facet {

/// As open_backend, for those who look behind its face.
[[nodiscard]] std::unique_ptr<TestableBackend> open_testable_backend(const BackendOptions& options);

}  // namespace facet
