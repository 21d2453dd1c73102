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

/// A rendering that keeps its record.
class RecordedRendering : public Rendering {
 public:
  [[nodiscard]] RenderRecord record() const final {
    RenderRecord record = record_;
    record.seconds = statistics().render_seconds;
    return record;
  }

 protected:
  /// kind: of the backend, as RenderRecord::backend says it.
  RecordedRendering(const Backend& backend, const char* kind, Precision precision,
                    const Scene& scene, const RenderSettings& settings)
      : record_(record_of(scene, settings)) {
    record_.backend = kind;
    record_.precision = precision;
    record_.device = backend.name();
    record_.driver = backend.driver();
    record_.stopped_by = StoppedBy::interrupt;
  }

  /// The record of a render on its way: of the samples that its pixels have.
  [[nodiscard]] RenderRecord record_so_far(const SamplingPlan& plan) const {
    RenderRecord record = this->record();
    const SampleRange whole = plan.whole_samples();
    // Without a whole one, the first is told that is lacking.
    record.samples = SampleRanges({whole.begin, std::max(whole.end, whole.begin + 1)});
    record.stopped_by = plan.is_uneven() ? StoppedBy::interrupt : StoppedBy::samples;
    return record;
  }

  /// What a render has come to. Until it is told, the record is that of one that was interrupted.
  void note(const SamplingOutcome& outcome) {
    record_.stopped_by = outcome.stopped_by;
    record_.samples = SampleRanges(outcome.samples);
    record_.adaptive = outcome.adaptive;
  }

 private:
  RenderRecord record_;
};

/// A scene that outlives all renderings of it.
[[nodiscard]] inline ScenePtr borrowed(const Scene& scene) {
  return {&scene, [](const Scene*) {}};
}

}  // namespace facet
