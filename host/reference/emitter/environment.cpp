#include "reference/emitter/environment.h"

#include <algorithm>
#include <numeric>

namespace facet::reference {

namespace {

/// Mean of the interpolated luminance over the cell between the texels (column, row) and (column +
/// 1, row + 1).
double cell_mean(const EnvironmentEmitter& map, int column, int row) {
  double sum = 0;
  for (const int y : {row, std::min(row + 1, map.height - 1)}) {
    for (const int x : {column, (column + 1) % map.width}) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
      sum += static_cast<double>(luminance(map.texels[i + static_cast<std::size_t>(x)]));
    }
  }
  return sum / 4;
}

}  // namespace

template <typename Real>
Environment<Real>::Environment(const EnvironmentEmitter& map, bool compensated)
    : width_(static_cast<std::size_t>(map.width)), height_(static_cast<std::size_t>(map.height)) {
  for (const Color& c : map.texels) texels_.emplace_back(c);
  for (std::size_t r = 0; r <= height_; ++r) {
    heights_.push_back(
        -std::cos(std::numbers::pi * static_cast<double>(r) / static_cast<double>(height_)));
  }
  std::vector<std::vector<double>> cells(height_);
  double brightest = 0;
  for (std::size_t r = 0; r < height_; ++r) {
    double sum = 0;
    for (int column = 0; column < map.width; ++column) {
      cells[r].push_back(cell_mean(map, column, static_cast<int>(r)));
      sum += cells[r].back();
      brightest = std::max(brightest, cells[r].back());
    }
    mean_luminance_ += sum * (heights_[r + 1] - heights_[r]) / (2 * static_cast<double>(width_));
  }
  // An environment that is the same everywhere has nothing above its mean but rounding errors.
  const bool subtracts = compensated && brightest - mean_luminance_ > 1e-6 * mean_luminance_;
  std::vector<double> row_weights;
  for (std::size_t r = 0; r < height_; ++r) {
    for (double& cell : cells[r]) cell = std::max(0.0, cell - (subtracts ? mean_luminance_ : 0));
    const double sum = std::accumulate(cells[r].begin(), cells[r].end(), 0.0);
    row_weights.push_back(sum * (heights_[r + 1] - heights_[r]));
    columns_.emplace_back(cells[r]);
  }
  rows_ = Choice(row_weights);
  for (std::size_t r = 0; r < height_; ++r) {
    const double angle =
        2 * std::numbers::pi / static_cast<double>(width_) * (heights_[r + 1] - heights_[r]);
    for (std::size_t c = 0; c < width_; ++c)
      densities_.push_back(rows_.probability(r) * columns_[r].probability(c) / angle);
  }
}

template class Environment<float>;
template class Environment<double>;

}  // namespace facet::reference
