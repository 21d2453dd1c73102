#pragma once
// Directions on the sphere, counted in bins and expected from a density.
#include <functional>
#include <span>
#include <vector>

#include "core/maths.h"

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
  /// The bin of a unit direction.
  [[nodiscard]] std::size_t bin(double cosine, double phi) const;
};

/// A direction's coordinates on the histogram.
struct SpherePoint {
  double cosine = 0;
  double phi = 0;  ///< [0, 2 pi)
};

/// Precise near the poles, too, where the z of a float direction says little about its angle.
[[nodiscard]] SpherePoint sphere_point(const vec3& direction);

/// Densities (sr^-1) of many unit directions.
using Density = std::function<std::vector<double>(std::span<const vec3> directions)>;

/// Sets `expected` to samples times the density's integral over each bin: Gauss-Legendre quadrature
/// of 3x3 points over cells that are quartered until quartering no longer matters. A narrow peak is
/// found by what fell there: cells are quartered, too, while they hold more than a small share of
/// `points`. Returns false where the density is too rough to be integrated.
[[nodiscard]] bool integrate_expected(SphereHistogram& histogram, const Density& density,
                                      std::vector<SpherePoint> points);

}  // namespace facet::statistics
