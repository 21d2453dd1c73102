#pragma once
// The integral of a BSDF's density over bins of directions.
#include "statistics/direction_bins.h"

namespace facet::statistics {

struct PdfIntegral {
  std::vector<double> bins;  ///< by bin
  double total = 0;
  double error =
      0;  ///< of the total: a sixteenth of the differences between every cell's last two estimates
  std::uint64_t evaluations = 0;
};

/// Adaptive quadrature: nine Gauss points a cell, against four times nine in its quarters; quarters
/// take the place of cells that differ, and of cells whose corners or pilot samples know a higher
/// density than the points. Every round is one call of the evaluator.
[[nodiscard]] PdfIntegral integrate_pdf(BsdfEvaluator& evaluator, const vec3& wo,
                                        const DirectionBins& bins);

}  // namespace facet::statistics
