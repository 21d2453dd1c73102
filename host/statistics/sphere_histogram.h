#pragma once
// Directions on the sphere, counted in a grid of bins.
#include <vector>

#include "statistics/density_integral.h"

namespace facet::statistics {

/// Bins of equal solid angle: `rows` along cos theta from -1 to 1, `columns` along phi from 0 to 2
/// pi; row by row.
struct SphereHistogram {
  int rows = 0;
  int columns = 0;
  double samples = 0;  ///< drawn, those that fell in no bin included
  std::vector<double> observed;
  std::vector<double> expected;

  SphereHistogram(int row_count, int column_count);
  /// The bin of a direction, whose azimuth counts from the x axis.
  [[nodiscard]] std::size_t bin(const Coordinates& direction) const;
  /// The bins as cells for integrate_density, each with the pilots that lie in it. A bin that
  /// straddles the horizon, where densities end, is two cells.
  [[nodiscard]] std::vector<Cell> cells(const std::vector<Pilot>& pilots) const;
};

}  // namespace facet::statistics
