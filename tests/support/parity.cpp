#include "support/parity.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "render/features.h"

namespace facet::test {

parity::ParityReport compare_with_reference(const Scene& scene, const RenderSettings& settings) {
  KernelBackend& backend = kernel_backend();
  const std::unique_ptr<Rendering> rendering = backend.start(borrowed(scene), settings);
  parity::ParityReport report =
      parity::check_parity(scene, settings, {}, *rendering, [](double) { return true; });
  EXPECT_EQ(rendering->statistics().bound_hits, 0U);
  expect_silent_validation();
  return report;
}

void expect_parity(const Scene& scene, const RenderSettings& settings) {
  const parity::ParityReport report = compare_with_reference(scene, settings);
  EXPECT_GT(report.samples, 0U);
  for (const std::string& failing : report.failings()) ADD_FAILURE() << failing;
  for (const parity::DivergedSample& d : report.diverged) {
    if (d.turned.empty())
      ADD_FAILURE() << "pixel " << d.x << ',' << d.y << " sample " << d.sample << ": kernels "
                    << d.kernels.x << ' ' << d.kernels.y << ' ' << d.kernels.z << ", reference "
                    << d.reference.x << ' ' << d.reference.y << ' ' << d.reference.z
                    << "; decided by least: " << d.nearest;
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(3, report.suspects.size()); ++i)
    ADD_FAILURE() << "suspect: " << report.suspects[i].part << ", score "
                  << report.suspects[i].score;
}

bool samples_half_vectors(const Scene& scene) {
  const Features features = find_features(scene, whole_image(scene, 1));
  const Integrator& integrator = features.integrator;
  return features.rough_bsdfs &&
         (integrator.type.material_sampling || integrator.interaction_limit() != 1);
}

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> names;
  const std::filesystem::path root(FACET_SCENES);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    // The folder `tests` holds what `facet test` runs.
    if (entry.path().extension() == ".xml" && entry.path().parent_path().filename() != "tests")
      names.push_back(std::filesystem::relative(entry.path(), root).generic_string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

}  // namespace facet::test
