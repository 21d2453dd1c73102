#pragma once
// A backend with what the program's own tests ask of it beside renders.
#include <facet/backend.h>

#include "scene/settings.h"
#include "statistics/bsdf_evaluator.h"

namespace facet {

class TestableBackend : public Backend {
 public:
  [[nodiscard]] std::unique_ptr<Rendering> start(const ScenePtr& scene,
                                                 const RenderRequest& request) final {
    return start(scene, resolve(*scene, request));
  }

  /// The same with every choice made.
  [[nodiscard]] virtual std::unique_ptr<Rendering> start(const ScenePtr& scene,
                                                         const RenderSettings& settings) = 0;

  /// One BSDF by itself. The backend must outlive it.
  [[nodiscard]] virtual std::unique_ptr<statistics::BsdfEvaluator> evaluator(
      const Bsdf& bsdf, LobeSampling sampling) = 0;
};

/// A scene that outlives all renderings of it.
[[nodiscard]] inline ScenePtr borrowed(const Scene& scene) {
  return {&scene, [](const Scene*) {}};
}

}  // namespace facet
