// What parity makes of samples whose cause is known: a turned decision, rounding, a fault.
#include "reference/tracer.h"
#include "support/parity.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

using namespace reference;
using namespace parity;

struct Traced {
  Vec3<float> radiance{0};
  std::map<DecisionKey, Decision> decisions;
};

/// A shipped scene in the reference.
class Subject {
 public:
  Subject(const std::string& name, int width, int height)
      : scene(resized(load_scene(name), width, height)), world(scene, whole_image(scene, 1)) {}

  [[nodiscard]] SampleId id(int x, int y, std::uint32_t sample) const {
    return {static_cast<std::uint32_t>(y * scene.camera.width + x), sample, scene.seed,
            scene.sampler};
  }

  [[nodiscard]] Traced watched(int x, int y, std::uint32_t sample,
                               const ForcedOutcomes& forced = {},
                               std::uint32_t perturbation = 0) const {
    Watch watch(perturbation, forced);
    const Vec3<float> radiance =
        Tracer<float, Watch>(world, id(x, y, sample), watch).radiance(x, y);
    return {radiance, watch.decisions()};
  }

  static Scene resized(Scene scene, int width, int height) {
    scene.camera.width = width;
    scene.camera.height = height;
    return scene;
  }

  Scene scene;
  World<float> world;
};

class Explain : public ::testing::Test {
 protected:
  Subject box_{"cbox/cbox_conductors_path.xml", 60, 45};
};

TEST_F(Explain, a_watched_sample_is_the_sample) {
  for (int y = 0; y < box_.scene.camera.height; ++y) {
    for (int x = 0; x < box_.scene.camera.width; ++x) {
      Unwatched unwatched;
      const Vec3<float> plain =
          Tracer<float, Unwatched>(box_.world, box_.id(x, y, 3), unwatched).radiance(x, y);
      EXPECT_EQ(plain, box_.watched(x, y, 3).radiance) << x << ',' << y;
    }
  }
}

TEST_F(Explain, perturbations_move_a_sample_but_little) {
  int moved = 0;
  int small = 0;
  for (int x = 0; x < box_.scene.camera.width; ++x) {
    const Traced plain = box_.watched(x, 20, 0);
    ForcedOutcomes held;
    for (const auto& [key, decision] : plain.decisions) held[key] = decision.outcome;
    const Vec3<float> other = box_.watched(x, 20, 0, held, 1).radiance;
    moved += other != plain.radiance ? 1 : 0;
    small += agrees(other, plain.radiance, Vec3<double>(0), 1e-3) ? 1 : 0;
  }
  EXPECT_GT(moved, box_.scene.camera.width * 8 / 10);
  EXPECT_GT(small, box_.scene.camera.width * 8 / 10);
}

/// A perturbed run stands for a renderer that is right but rounds otherwise. Counts the decisions
/// that it turned; expects that every sample is explained.
void explain_rounding(const Subject& subject, std::uint32_t samples,
                      std::map<DecisionKind, int>& found) {
  for (std::uint32_t sample = 0; sample < samples; ++sample) {
    for (int y = 0; y < subject.scene.camera.height; ++y) {
      for (int x = 0; x < subject.scene.camera.width; ++x) {
        const Vec3<float> f = subject.watched(x, y, sample).radiance;
        const Vec3<float> other = subject.watched(x, y, sample, {}, 5 + sample).radiance;
        if (agrees(other, f, Vec3<double>(0), Tolerance{}.relative)) continue;
        const Explanation e = explain(subject.world, x, y, subject.id(x, y, sample), other, {});
        EXPECT_TRUE(e.explained()) << x << ',' << y << " sample " << sample;
        for (const TurnedDecision& t : e.turned) ++found[t.key.kind];
      }
    }
  }
}

TEST_F(Explain, explains_all_that_rounding_does) {
  std::map<DecisionKind, int> found;
  explain_rounding(box_, 4, found);
  explain_rounding({"serapis/serapis_rough_mis.xml", 120, 90}, 12, found);
  explain_rounding({"furnace/furnace_050.xml", 60, 60}, 4, found);
  for (const auto& [kind, count] : found) GTEST_LOG_(INFO) << decision_name(kind) << ": " << count;
  EXPECT_GE(found.size(), 2U) << "decisions of several kinds";
}

TEST_F(Explain, does_not_explain_a_fault) {
  int explained = 0;
  int samples = 0;
  for (int y = 0; y < box_.scene.camera.height; y += 3) {
    for (int x = 0; x < box_.scene.camera.width; x += 3) {
      const Vec3<float> f = box_.watched(x, y, 1).radiance;
      if (f == Vec3<float>(0)) continue;
      ++samples;
      if (explain(box_.world, x, y, box_.id(x, y, 1), f * 1.001F, {}).explained()) ++explained;
    }
  }
  EXPECT_GT(samples, 100);
  // Long paths between curved mirrors may be ill-conditioned to a thousandth.
  EXPECT_LE(explained, samples / 20);
}

TEST_F(Explain, tells_what_failing_samples_have_in_common) {
  const Scene scene = Subject::resized(load_scene("cbox/cbox_substrate_mis.xml"), 60, 45);
  const RenderSettings settings = whole_image(scene, 2);
  // The kernels get another scene: the coat of one ball is rougher.
  Scene wrong = scene;
  for (Bsdf& b : wrong.bsdfs) {
    if (auto* substrate = std::get_if<bsdf::RoughSubstrate>(&b)) substrate->alpha.value *= 1.1F;
  }
  const std::unique_ptr<Rendering> kernels = kernel_backend().start(borrowed(wrong), settings);
  const ParityReport report =
      check_parity(scene, settings, {}, *kernels, [](double) { return true; });
  EXPECT_GT(report.unexplained(), 100U);
  ASSERT_FALSE(report.suspects.empty());
  EXPECT_NE(report.suspects[0].part.find("roughsubstrate"), std::string::npos)
      << report.suspects[0].part;
  EXPECT_GT(report.suspects[0].score, 0.5);
}

}  // namespace
}  // namespace facet::test
