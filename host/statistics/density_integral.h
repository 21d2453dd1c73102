#pragma once
// The integral of a BSDF's density over bins of directions.
#include <vector>

#include "statistics/bsdf_evaluator.h"
#include "statistics/sphere_coordinates.h"

namespace facet::statistics {

/// A sample that shows where the density is.
struct Pilot {
  Coordinates at;
  double pdf = 0;
};

/// A rectangle that lies within one bin, with the pilot samples that lie within it.
struct Cell {
  Rectangle area;
  std::uint32_t bin = 0;
  std::vector<Pilot> pilots;
};

struct QuadratureOptions {
  /// Difference of a cell's two estimates that is small enough.
  double tolerance = 5e-7;
  std::uint64_t most_evaluations = 32'000'000;
};

struct DensityIntegral {
  std::vector<double> bins;  ///< by bin
  double total = 0;
  /// Of the total: a sixteenth of the differences between every cell's last two estimates.
  double error = 0;
  std::uint64_t evaluations = 0;
};

/// Adaptive quadrature: nine Gauss points a cell, against four times nine in its quarters; quarters
/// take the place of cells that differ, and of cells whose corners or pilot samples know a higher
/// density than the points. Every round is one call of the evaluator.
[[nodiscard]] DensityIntegral integrate_density(BsdfEvaluator& evaluator, const vec3& wo,
                                                const SphereCoordinates& coordinates,
                                                std::vector<Cell> cells, std::size_t bin_count,
                                                const QuadratureOptions& options = {});

}  // namespace facet::statistics
