#pragma once
// Whether two Monte Carlo images estimate the same expectation, cell by cell.
#include <facet/film.h>

#include <string>

namespace facet {

struct ZTestResult {
  std::size_t cells = 0;       ///< tested cells times channels
  std::size_t untestable = 0;  ///< cells that stay without enough contributions, times channels
  double largest_z = 0;        ///< over all tests
  double critical_z = 0;       ///< the normal quantile under the correction
  int worst_x = 0;             ///< pixel at the worst cell's corner
  int worst_y = 0;
  int worst_size = 1;       ///< the worst cell's side, pixels
  std::size_t unequal = 0;  ///< cells without variance whose values differ

  /// All tests hold, and fewer than 1 % of the cells are untestable.
  [[nodiscard]] bool passed() const {
    return largest_z <= critical_z && unequal == 0 && 100 * untestable < cells + untestable;
  }
  [[nodiscard]] std::string describe() const;
};

/// z = |a - b| / sqrt(var_a + var_b) per cell and channel against the normal quantile of the
/// two-sided significance, with Sidak's correction over cells times channels. Where both variances
/// are 0, the values must be equal. Both images need the variance channels of --aov variance and
/// the same size.
///
/// A cell is a pixel, merged up to 16x16 until both images hold at least 30 contributions there, so
/// that the normal distribution applies. Contributions are counted as L. Kish's effective number
/// (sum x)^2 / sum x^2: a thousand samples of which one outweighs all others are one contribution.
/// And since a cell may have been spared the rare bright sample that its neighbours show, cells are
/// divided from above, only as long as the larger cell's number leaves 30 for each part, and a
/// part's variance counts at least as its share of the larger cell's.
///
/// least_cell, a power of two: cells of fewer pixels are not tested by themselves. Larger ones show
/// smaller differences, where these are alike all over the cell.
[[nodiscard]] ZTestResult z_test(const Image& a, const Image& b, double significance,
                                 int least_cell = 1);

/// Sides of cells that can be the least.
inline constexpr int largest_cell = 16;

}  // namespace facet
