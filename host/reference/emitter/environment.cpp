#include "reference/emitter/environment.h"

#include <algorithm>

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
Environment<Real>::Environment(const EnvironmentEmitter& map)
    : width_(static_cast<std::size_t>(map.width)), height_(static_cast<std::size_t>(map.height)) {
  for (const Color& c : map.texels) texels_.emplace_back(c);
  for (std::size_t r = 0; r <= height_; ++r) {
    heights_.push_back(
        -std::cos(std::numbers::pi * static_cast<double>(r) / static_cast<double>(height_)));
  }
  std::vector<double> row_weights;
  for (int row = 0; row < map.height; ++row) {
    std::vector<double> weights;
    double sum = 0;
    for (int column = 0; column < map.width; ++column) {
      weights.push_back(cell_mean(map, column, row));
      sum += weights.back();
    }
    columns_.emplace_back(weights);
    const auto r = static_cast<std::size_t>(row);
    row_weights.push_back(sum * (heights_[r + 1] - heights_[r]));
    mean_luminance_ += row_weights.back() / (2 * static_cast<double>(width_));
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
