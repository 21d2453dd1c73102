#include "door/open_backend.h"

#include "core/memory.h"
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

std::unique_ptr<Backend> open_backend(const BackendOptions& options) {
  return open_testable_backend(options);
}

}  // namespace facet
