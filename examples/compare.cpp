// compare SCENE.xml SAMPLES: how far a render by the kernels is from one of ten times the samples
// by the reference, with progress on standard error.
#include <facet/facet.h>

#include <cstdio>
#include <cstdlib>

namespace {

/// Shows the share that is done. Returning false would end the render.
bool show(double done, const facet::RenderStatistics& /*statistics*/) {
  std::fprintf(stderr, "\r%3.0f %%", 100 * done);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fputs("usage: compare SCENE.xml SAMPLES\n", stderr), 2;
  try {
    const int samples = std::atoi(argv[2]);
    const auto scene = facet::load_scene(argv[1]);
    const auto kernels = facet::open_backend();
    const auto reference = facet::open_backend({.reference = facet::Precision::double_});
    const facet::ImageSize size{64, 48};
    const facet::Film film = kernels->render(scene, {.samples = samples, .size = size});
    // Another seed: with the same one, both would err alike.
    const facet::Film exact = reference->render(
        scene, {.samples = 10 * samples, .size = size, .seed = 1, .progress = show});
    const facet::ComparisonSummary errors =
        facet::compare(facet::develop(film, false), facet::develop(exact, false));
    std::printf("\nRMSE %.4g, relMSE %.4g, FLIP %.4g after %.2f s on %s\n", errors.rmse,
                errors.relmse, errors.flip, film.record.seconds, film.record.device.c_str());
  } catch (const facet::Error& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
}
