#pragma once
// Backends by their options.
#include "scene/testable_backend.h"

namespace facet {

/// As open_backend, for those who look behind its face.
[[nodiscard]] std::unique_ptr<TestableBackend> open_testable_backend(const BackendOptions& options);

/// The devices that BackendOptions::device asks to share renders, each as an option by itself;
/// empty where it asks for one. Throws DeviceError where the devices cannot be listed.
[[nodiscard]] std::vector<std::string> shared_devices(const std::string& device);

}  // namespace facet
