#pragma once
// The pixels that a render's settings name.
#include "image/film.h"
#include "reference/random.h"
#include "reference/real.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace facet::reference {

/// A film with squares for the crop.
[[nodiscard]] inline Film blank_film(const Scene& scene, const RenderSettings& settings) {
  const Crop& c = settings.crop;
  return make_film(c.x1 - c.x0, c.y1 - c.y0, {c.x0, c.y0, scene.camera.width, scene.camera.height}, true);
}

/// A sample of the crop's pixel i, counted row by row.
struct CropSample {
  int x = 0;  ///< in the whole image
  int y = 0;
  SampleId id;

  CropSample(const Scene& scene, const RenderSettings& settings, std::size_t i, std::uint32_t sample) {
    const auto width = static_cast<std::size_t>(settings.crop.x1 - settings.crop.x0);
    x = settings.crop.x0 + static_cast<int>(i % width);
    y = settings.crop.y0 + static_cast<int>(i / width);
    id = {static_cast<std::uint32_t>(y * scene.camera.width + x), sample, settings.seed, scene.sampler};
  }
};

/// Finite and not negative in every channel.
template <typename Real>
[[nodiscard]] bool is_good(const Vec3<Real>& radiance) {
  for (int c = 0; c < 3; ++c) {
    if (!(radiance[c] >= 0 && radiance[c] <= std::numeric_limits<Real>::max())) return false;
  }
  return true;
}

}  // namespace facet::reference
