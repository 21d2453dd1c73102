#pragma once
// The kernels' hits against brute force in double precision.
#include <string>

#include "scene/scene.h"

namespace facet::test {

/// How the kernels' hits compare with brute force.
struct Comparison {
  std::size_t rays = 0;
  std::size_t hits = 0;
  std::size_t unexplained = 0;  ///< differences that rounding cannot make
  std::string first;
};

/// Of the camera's rays, one a pixel. `slack` bounds rounding: of t relative to t, and of whether
/// barycentric weights are inside; what the weights are is bounded by ten times as much.
[[nodiscard]] Comparison compare_with_brute_force(const Scene& scene, double slack,
                                                  bool storage_buffers = false);

/// By both ways to fetch geometry.
void expect_right_hits(const Scene& scene, double slack, std::size_t least_hits);

}  // namespace facet::test
