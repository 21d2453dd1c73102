#pragma once

#include <cstddef>
#include <vector>

#include "vec3.h"

namespace facet::generate {

/// Snail curls such as cover the heads of antique statues: flattened knobs with a spiral groove.
class Curls {
 public:
  /// One curl on a surface with the unit normal `outward`; `turn` (radians) and `handed` (±1)
  /// orient its spiral.
  struct Curl {
    Vec3 centre;
    Vec3 outward;
    double radius = 0;
    double turn = 0;
    double handed = 1;
  };

  explicit Curls(std::vector<Curl> curls);

  /// Distance to the nearest curls, blended; `far_away` where none is near.
  double distance(Vec3 p, double far_away) const;

 private:
  struct Placed {
    Curl curl;
    Vec3 tangent;
    Vec3 bitangent;
  };

  static double distance_to(const Placed& placed, Vec3 p);

  std::vector<Placed> curls_;
  double lowest_ = 0;
  std::vector<std::vector<std::size_t>> slabs_;  ///< Which curls reach into each horizontal slab.
};

/// Curls all over an ellipsoid, evenly (a Fibonacci lattice) but with some disorder, where `keep`
/// allows one.
template <typename Keep>
std::vector<Curls::Curl> scatter_curls(Vec3 centre, Vec3 axes, std::size_t count, double radius,
                                       const Keep& keep);

}  // namespace facet::generate

#include "curls_scatter.h"
