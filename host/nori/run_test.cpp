// The cases of a test file, one after the other.
#include <random>

#include "nori/nori_tests.h"
#include "statistics/hypothesis.h"

namespace facet::nori {

namespace {

constexpr int samples_per_bin = 5000;

/// Numbers that follow from the seed on every machine.
class Numbers {
 public:
  explicit Numbers(std::uint32_t seed) : engine_(seed) {}
  std::uint32_t word() { return static_cast<std::uint32_t>(engine_()); }
  /// In (0, 1).
  double unit() { return (word() + 0.5) * 0x1p-32; }

 private:
  std::mt19937 engine_;
};

std::string describe(const TestedBsdf& b) {
  return fmt::format("{} (line {})", b.title, b.where.line);
}

class Run {
 public:
  Run(const StatisticalTest& test, TestableBackend& backend, LobeSampling sampling,
      std::uint32_t seed)
      : test_(test),
        backend_(backend),
        sampling_(sampling),
        numbers_(seed),
        significance_(statistics::sidak_significance(test.significance(), test.case_count())) {}

  /// Scenes, then BSDFs; a file has either.
  void cases(const std::function<bool(const TestCase&)>& report) {
    for (std::size_t i = 0; i < test_.scenes.size(); ++i) {
      if (!report(scene_case(i))) return;
    }
    for (std::size_t i = 0; i < test_.bsdfs.size(); ++i) {
      const std::unique_ptr<BsdfEvaluator> bsdf =
          backend_.evaluator(test_.bsdfs[i].bsdf, sampling_);
      const std::size_t count = test_.case_count() / test_.bsdfs.size();
      for (std::size_t k = 0; k < count; ++k) {
        const bool is_t = std::holds_alternative<TTest>(test_.kind);
        if (!report(is_t ? albedo_case(*bsdf, i, k) : direction_case(*bsdf, i, k))) return;
      }
    }
  }

 private:
  TestCase scene_case(std::size_t i) {
    const auto& t = std::get<TTest>(test_.kind);
    Scene scene = test_.scenes[i].scene;
    const ImagePlan plan = plan_image(scene.camera.width, scene.camera.height,
                                      static_cast<std::uint32_t>(t.sample_count));
    // Points all over the image, each as likely as any other and independent of the others.
    scene.camera.filter = BoxFilter{};
    RenderRequest request;
    request.samples = static_cast<int>(plan.passes);
    request.size = {plan.width, plan.height};
    request.sampler = "independent";
    request.seed = numbers_.word();
    request.sampling = sampling_;
    TestCase result;
    result.where = test_.scenes[i].where;
    result.name =
        fmt::format("scene {} (line {}), {}", i + 1, result.where.line, scene.integrator.type.name);
    const std::unique_ptr<Rendering> rendering = backend_.start(borrowed(scene), request);
    result.estimate = mean_luminance(
        [&](std::uint32_t sample) { return rendering->sample(sample); }, plan.passes);
    result.bound_hits = rendering->statistics().bound_hits;
    result.reference = t.references[i];
    result.verdict = t_test(result.estimate, result.reference, significance_);
    return result;
  }

  TestCase albedo_case(BsdfEvaluator& bsdf, std::size_t i, std::size_t angle) {
    const auto& t = std::get<TTest>(test_.kind);
    TestCase result;
    result.where = test_.bsdfs[i].where;
    result.name = fmt::format("{} at {:g} degrees", describe(test_.bsdfs[i]), t.angles[angle]);
    result.estimate = sample_albedo(bsdf, t.angles[angle],
                                    static_cast<std::uint32_t>(t.sample_count), numbers_.word());
    result.reference = t.references[i * t.angles.size() + angle];
    result.verdict = t_test(result.estimate, result.reference, significance_);
    return result;
  }

  TestCase direction_case(BsdfEvaluator& bsdf, std::size_t i, std::size_t direction) {
    const auto& chi = std::get<ChiSquaredTest>(test_.kind);
    // As in Nori, uniform over the hemisphere: grazing viewers are as likely as others.
    const double cosine = numbers_.unit();
    const double phi = glm::radians(360 * numbers_.unit());
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    const long long automatic = 2LL * chi.resolution * chi.resolution * samples_per_bin;
    const long long count =
        chi.sample_count > 0 ? chi.sample_count : std::min(automatic, 1LL << 30);
    TestCase result;
    result.where = test_.bsdfs[i].where;
    result.name =
        fmt::format("{} from direction {} (theta {:.1f}, phi {:.1f})", describe(test_.bsdfs[i]),
                    direction + 1, glm::degrees(std::acos(cosine)), glm::degrees(phi));
    result.histogram =
        make_histogram(bsdf, vec3(sine * std::cos(phi), sine * std::sin(phi), cosine),
                       chi.resolution, static_cast<std::uint32_t>(count), numbers_.word());
    if (result.histogram) {
      result.verdict = chi_squared_test(*result.histogram, chi.least_expected, significance_);
    } else {
      result.verdict.note = "the density is too rough to be integrated";
    }
    return result;
  }

  const StatisticalTest& test_;
  TestableBackend& backend_;
  LobeSampling sampling_;
  Numbers numbers_;
  double significance_;
};

}  // namespace

void run_test(const StatisticalTest& test, TestableBackend& backend, LobeSampling sampling,
              std::uint32_t seed, const std::function<bool(const TestCase&)>& report) {
  Run(test, backend, sampling, seed).cases(report);
}

}  // namespace facet::nori
