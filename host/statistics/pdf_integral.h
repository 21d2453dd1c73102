#pragma once
// The integral of a BSDF's density over bins of directions.
#include "statistics/direction_bins.h"

namespace facet::statistics {

struct PdfIntegral {
  std::vector<double> bins;  ///< by bin
  double total = 0;
  double error = 0;  ///< of the total: sum of the differences between the last two estimates of every cell
  std::uint64_t evaluations = 0;
};

/// Adaptive quadrature: nine Gauss points a cell, against four times nine in its quarters; quarters take the
/// place of cells that differ, and of cells with pilot samples where the integral finds no mass. Every round
/// is one call of the evaluator.
[[nodiscard]] PdfIntegral integrate_pdf(BsdfEvaluator& evaluator, const vec3& wo, const DirectionBins& bins,
                                        std::size_t pilot_count);

}  // namespace facet::statistics
