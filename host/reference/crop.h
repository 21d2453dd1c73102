#pragma once
// The pixels that a render's settings name.
#include "image/film.h"
#include "reference/random.h"
#include "reference/real.h"
#include "scene/settings.h"

namespace facet::reference {

/// A film with squares for the crop.
[[nodiscard]] inline Film blank_film(const RenderSettings& settings) {
  return make_film(settings.crop_width(), settings.crop_height(), settings.window(), true);
}

/// A sample of the crop's pixel i, counted row by row.
struct CropSample {
  int x = 0;  ///< in the whole image
  int y = 0;
  SampleId id;

  CropSample(const RenderSettings& settings, std::size_t i, std::uint32_t sample) {
    const auto width = static_cast<std::size_t>(settings.crop_width());
    x = settings.crop.x0 + static_cast<int>(i % width);
    y = settings.crop.y0 + static_cast<int>(i / width);
    id = {static_cast<std::uint32_t>(y * settings.size.width + x),
          sample,
          settings.seed,
          settings.sampler,
          shared::uvec2(x, y),
          settings.order_bits()};
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
