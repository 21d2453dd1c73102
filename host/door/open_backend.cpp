#include "door/open_backend.h"

#include <fmt/format.h>

#include "core/memory.h"
#include "core/text.h"
#include "door/shared_backend.h"
#include "gpu/device.h"
#include "reference/reference_backend.h"
#include "render/kernel_backend.h"

namespace facet {

Film Backend::render(const ScenePtr& scene, const RenderRequest& request) {
  const std::unique_ptr<Rendering> rendering = start(scene, request);
  rendering->run(request.progress);
  return rendering->film();
}

std::unique_ptr<TestableBackend> open_testable_backend(const BackendOptions& options) {
  if (options.reference) return reference::make_backend(*options.reference);
  const Activity activity("opening the device");
  return std::make_unique<KernelBackend>(options.device, options.validate);
}

std::vector<std::string> shared_devices(const std::string& device) {
  std::vector<std::string> names;
  if (device == "all") {
    for (const gpu::DeviceInfo& info : gpu::list_devices()) {
      if (info.lacks.empty()) names.push_back(fmt::format("{}", info.index));
    }
    return names;
  }
  if (device.find(',') == std::string::npos) return {};
  // A device's own name may have a comma.
  for (const gpu::DeviceInfo& info : gpu::list_devices()) {
    if (lower_case(info.name).find(lower_case(device)) != std::string::npos) return {};
  }
  for (const std::string_view name : split_list(device)) names.emplace_back(name);
  return names;
}

std::unique_ptr<Backend> open_backend(const BackendOptions& options) {
  const std::vector<std::string> devices =
      options.reference ? std::vector<std::string>() : shared_devices(options.device);
  if (devices.size() == 1)
    return open_testable_backend({.device = devices[0], .validate = options.validate});
  if (devices.empty()) {
    // Whoever wants all has at least the message of the one that is missing.
    return open_testable_backend({.device = options.device == "all" ? "" : options.device,
                                  .reference = options.reference,
                                  .validate = options.validate});
  }
  std::vector<std::unique_ptr<TestableBackend>> backends;
  backends.reserve(devices.size());
  for (const std::string& device : devices) {
    backends.push_back(
        device == "reference"
            ? open_testable_backend({.reference = Precision::float_})
            : open_testable_backend({.device = device, .validate = options.validate}));
  }
  return share_renders(std::move(backends));
}

}  // namespace facet
