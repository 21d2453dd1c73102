#pragma once
// How to share a render among many nodes, from what a short one took.
#include <facet/film.h>

namespace facet::tradeoff {

/// What a short render on one node has shown.
struct FarmMeasurement {
  double start_seconds = 0;       ///< of a process before its first sample, and behind its last
  double seconds_per_sample = 0;  ///< of one sample of every pixel
  std::uint32_t samples = 0;      ///< of a pixel, that there were
  double relative_upper = 0;  ///< of the image's relative error after them, with 95 % confidence
  double part_bytes = 0;      ///< of a part's file
  double merge_seconds = 0;   ///< that merging takes a part
};

struct FarmWish {
  std::uint32_t nodes = 1;
  std::optional<std::uint32_t> samples = {};  ///< of a pixel
  std::optional<double> error = {};  ///< relative, that is enough; where there are no samples
  double longest_part = 600;         ///< seconds that a part may take, about
};

struct FarmPlan {
  std::uint32_t samples = 0;  ///< of a pixel, of all parts together
  std::uint32_t parts = 0;
  std::uint32_t part_samples = 0;  ///< of a pixel, of the largest part
  std::uint32_t rounds = 0;        ///< parts that the busiest node renders
  double part_seconds = 0;         ///< of the largest part's process
  double merge_seconds = 0;
  double seconds = 0;  ///< from the start of the first part to the merged image
  double node_hours = 0;
  double bytes = 0;  ///< of all parts
};

/// As many parts for each node as keep them below the longest; fewer where starting would take more
/// than a tenth of a part's time. The error falls with the root of the number of samples at least,
/// which is what independent samples do. Throws InputError where no number of samples can be told.
[[nodiscard]] FarmPlan plan_farm(const FarmMeasurement& measured, const FarmWish& wish);

}  // namespace facet::tradeoff
