#pragma once
// How the time of a frame grows with one number while all else stays.
#include <functional>
#include <string>
#include <vector>

#include "core/figure.h"
#include "gpu/device.h"

namespace facet::bench {

struct GrowthPoint {
  double number = 0;
  Figure seconds;  ///< of one frame
};

struct GrowthSeries {
  std::string of;  ///< what grows: "pixels", "samples a pixel", "emitters"
  std::vector<GrowthPoint> points;
};

/// What is measured, and how often.
struct GrowthOptions {
  int repeats = 7;
  /// Fewer and smaller frames, a tenth of the work: images to 256x256 pixels, 16 samples, 256
  /// emitters.
  bool quick = false;
};

/// Renders a generated scene of 10,000 triangles with direct_mis: at sizes from 64x64 to 1024x1024
/// pixels, with 1 to 256 samples, and with its light parted into 1 to 4096 emitters, of which one
/// is chosen by power. Each frame `repeats` times, all of a series in turn. Asks `go_on` before
/// each frame; where it says no, those series come back that are complete.
[[nodiscard]] std::vector<GrowthSeries> measure_growth(gpu::Device& device,
                                                       const GrowthOptions& options,
                                                       const std::function<bool()>& go_on);

}  // namespace facet::bench
