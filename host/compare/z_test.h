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

inline constexpr int largest_cell = 16;

/// What is tested by itself.
struct ZTestCells {
  /// Side of the least cell in pixels, a power of two up to largest_cell. Larger ones show smaller
  /// differences, where these are alike all over the cell.
  int least = 1;
  /// Contributions that a cell must have. With 30, quantiles of probabilities about 10^-5 are right
  /// within a factor of seven where few samples carry all; with 1000 within one and a half.
  double contributions = 30;
};

/// z = |a - b| / sqrt(var_a + var_b) per cell and channel against the normal quantile of the
/// two-sided significance, with Sidak's correction over cells times channels. Where both variances
/// are 0, the values must be equal. Both images need the variance channels of --aov variance and
/// the same size.
///
/// A cell is a pixel, merged up to 16x16 until both images hold at least so many contributions (30)
/// there, so that the normal distribution applies. Contributions are counted as L. Kish's effective
/// number (sum x)^2 / sum x^2: a thousand samples of which one outweighs all others are one
/// contribution. And since a cell may have been spared the rare bright sample that its neighbours
/// show, cells are divided from above, only as long as the larger cell's number leaves as many for
/// each part, and a part's variance counts at least as its share of the larger cell's.
[[nodiscard]] ZTestResult z_test(const Image& a, const Image& b, double significance,
                                 const ZTestCells& cells = {});

}  // namespace facet
