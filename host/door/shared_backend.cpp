#include "door/shared_backend.h"

#include "core/error.h"
#include "door/shared_rendering.h"
#include "image/record.h"

namespace facet {

namespace {

class SharedBackend : public Backend {
 public:
  explicit SharedBackend(std::vector<std::unique_ptr<TestableBackend>> backends)
      : backends_(std::move(backends)) {}

  [[nodiscard]] std::string name() const override {
    std::string names;
    for (const auto& backend : backends_) add_items(names, backend->name());
    return names;
  }
  [[nodiscard]] std::string driver() const override {
    std::string drivers;
    for (const auto& backend : backends_) add_items(drivers, backend->driver());
    return drivers;
  }
  [[nodiscard]] std::vector<std::string> validation_messages() const override {
    std::vector<std::string> messages;
    for (const auto& backend : backends_) {
      for (std::string& message : backend->validation_messages())
        messages.push_back(std::move(message));
    }
    return messages;
  }
  [[nodiscard]] std::vector<std::string> remarks() const override { return remarks_; }

  [[nodiscard]] std::unique_ptr<Rendering> start(const ScenePtr& scene,
                                                 const RenderRequest& request) override {
    const RenderSettings settings = resolve(*scene, request);
    if (settings.error || settings.deadline || settings.adaptive)
      throw InputError(
          "several devices share a number of samples: an error or a time to stop at and adaptive "
          "sampling are of one device");
    return std::make_unique<SharedRendering>(backends_, scene, settings, remarks_);
  }

 private:
  std::vector<std::unique_ptr<TestableBackend>> backends_;
  std::vector<std::string> remarks_;
};

}  // namespace

std::unique_ptr<Backend> share_renders(std::vector<std::unique_ptr<TestableBackend>> backends) {
  return std::make_unique<SharedBackend>(std::move(backends));
}

}  // namespace facet
