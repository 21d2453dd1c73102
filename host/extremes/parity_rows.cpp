// The kernels beside the reference in the scenes at the edge.
#include "extremes/scene_parts.h"
#include "parity/parity.h"

namespace facet::extremes {

namespace {

Check parity_check(const EdgeScene& edge) {
  Check check = make_check("parity", edge.name,
                           "32x24 pixels, 4 samples (16x12 where quick), reference in float and in "
                           "double",
                           "promises of parity that are broken", 0);
  check.argued = edge.argued;
  check.measure = [make_scene = edge.scene](Bench& bench) {
    const ScenePtr scene = make_scene();
    RenderRequest request;
    request.size = bench.quick() ? ImageSize{16, 12} : ImageSize{32, 24};
    request.samples = 4;
    const RenderSettings settings = resolve(*scene, request);
    const std::unique_ptr<Rendering> kernels = bench.backend().start(scene, settings);
    const parity::ParityReport report =
        parity::check_parity(*scene, settings, parity::tolerance_on(bench.device().is_cpu()),
                             *kernels, [&](double done) {
                               bench.tell(done);
                               return true;
                             });
    const std::vector<std::string> failings = report.failings();
    Finding finding;
    finding.add(static_cast<double>(failings.size()), [&] { return failings.front(); });
    finding.inputs = report.samples;
    return finding;
  };
  return check;
}

}  // namespace

std::vector<Check> parity_checks() {
  std::vector<Check> checks;
  for (const std::vector<EdgeScene>& some :
       std::array{surface_scenes(), light_scenes(), image_scenes(), whole_scenes()}) {
    for (const EdgeScene& edge : some) checks.push_back(parity_check(edge));
  }
  return checks;
}

}  // namespace facet::extremes
