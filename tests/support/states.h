#pragma once
// States of renders that never were.
#include "image/film.h"
#include "image/render_state.h"

namespace facet::test {

/// Of a path tracer's image with squares, which has its first `samples` samples; all else is left
/// at its defaults.
[[nodiscard]] inline RenderState make_state(int width, int height, const ImageWindow& window,
                                            std::uint32_t samples) {
  RenderState state;
  state.film = make_film(width, height, window, true);
  RenderRecord& record = state.film.record;
  record.version = "1.2.3";
  record.scene = "scene.xml";
  record.integrator = "path_mis";
  record.sampler = "sobol";
  record.backend = "vulkan";
  record.device = "llvmpipe (LLVM 15)";
  record.driver = "llvmpipe";
  record.filter = "box";
  record.samples.add({0, samples});
  double value = 0;
  for (PixelSums& pixel : state.film.pixels) {
    for (std::uint32_t k = 0; k < samples; ++k) {
      value = value * 1.7 + 0.1;
      value -= static_cast<int>(value);
      pixel.add({value, 2 * value, 0});
    }
  }
  return state;
}

}  // namespace facet::test
