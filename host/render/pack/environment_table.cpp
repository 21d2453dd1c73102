#include "render/pack/environment_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/pack/choice.h"

namespace facet {

namespace {

/// Mean over each cell [x, x + 1) x [y, y + 1) of the bilinearly interpolated luminance: of the
/// texels at its corners, so that it is positive wherever the interpolated value is.
std::vector<double> cell_luminances(const EnvironmentEmitter& e) {
  const auto w = static_cast<std::size_t>(e.width);
  const auto h = static_cast<std::size_t>(e.height);
  std::vector<double> cells(w * h);
  for (std::size_t y = 0; y < h; ++y) {
    // Both texels of a row to the right of a column.
    const auto pair = [&](std::size_t row, std::size_t x) {
      return static_cast<double>(luminance(e.texels[row * w + x])) +
             static_cast<double>(luminance(e.texels[row * w + (x + 1) % w]));
    };
    for (std::size_t x = 0; x < w; ++x)
      cells[y * w + x] = 0.25 * (pair(y, x) + pair(std::min(y + 1, h - 1), x));
  }
  return cells;
}

}  // namespace

EnvironmentTable make_environment_table(const EnvironmentEmitter& e) {
  const auto w = static_cast<std::size_t>(e.width);
  const auto h = static_cast<std::size_t>(e.height);
  const std::vector<double> cells = cell_luminances(e);
  EnvironmentTable table;
  std::vector<double> row_weights(h);
  // Row r covers the directions whose y lies in [-cos(pi r/H), -cos(pi (r+1)/H)]: up is the last
  // row.
  const auto border = [&](std::size_t r) {
    return -std::cos(std::numbers::pi * static_cast<double>(r) / static_cast<double>(h));
  };
  for (std::size_t y = 0; y < h; ++y) {
    double sum = 0;
    for (std::size_t x = 0; x < w; ++x) sum += cells[y * w + x];
    row_weights[y] = sum * (border(y + 1) - border(y));
    table.mean_luminance += row_weights[y] / (2.0 * static_cast<double>(w));
  }
  const std::vector<std::uint32_t> row_counts = cumulative_counts(row_weights);
  table.texels.reserve(w * h);
  table.columns.reserve(w * h);
  for (std::size_t y = 0; y < h; ++y) {
    table.rows.push_back(
        {row_counts[y], static_cast<float>(border(y)), static_cast<float>(border(y + 1)), 0});
    const std::vector<std::uint32_t> counts = cumulative_counts(std::span(cells).subspan(y * w, w));
    table.columns.insert(table.columns.end(), counts.begin(), counts.end());
    const double row_probability = choice_probability(row_counts, y);
    const double cell_angle =
        2 * std::numbers::pi / static_cast<double>(w) * (border(y + 1) - border(y));
    for (std::size_t x = 0; x < w; ++x) {
      const double density = row_probability * choice_probability(counts, x) / cell_angle;
      table.texels.emplace_back(e.texels[y * w + x], static_cast<float>(density));
    }
  }
  return table;
}

}  // namespace facet
