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

/// y of the border below a row of directions: up is the last row.
double border_of(std::size_t row, std::size_t rows) {
  return -std::cos(std::numbers::pi * static_cast<double>(row) / static_cast<double>(rows));
}

/// Mean of the cells over the sphere.
double mean_of_cells(const std::vector<double>& cells, std::size_t w, std::size_t h) {
  double mean = 0;
  for (std::size_t y = 0; y < h; ++y) {
    double sum = 0;
    for (std::size_t x = 0; x < w; ++x) sum += cells[y * w + x];
    mean += sum * (border_of(y + 1, h) - border_of(y, h)) / (2.0 * static_cast<double>(w));
  }
  return mean;
}

/// Leaves of each cell what exceeds the mean, unless that is nothing anywhere.
void compensate(std::vector<double>& cells, double mean) {
  std::vector<double> rest;
  rest.reserve(cells.size());
  for (const double cell : cells) rest.push_back(std::max(0.0, cell - mean));
  // The mean of equal cells can be a last bit off.
  const auto exceeds = [mean](double v) { return v > 1e-6 * mean; };
  if (std::any_of(rest.begin(), rest.end(), exceeds)) cells = std::move(rest);
}

}  // namespace

EnvironmentTable make_environment_table(const EnvironmentEmitter& e, bool compensated) {
  const auto w = static_cast<std::size_t>(e.width);
  const auto h = static_cast<std::size_t>(e.height);
  std::vector<double> cells = cell_luminances(e);
  EnvironmentTable table;
  table.mean_luminance = mean_of_cells(cells, w, h);
  if (compensated) compensate(cells, table.mean_luminance);
  std::vector<double> row_weights(h);
  const auto border = [&](std::size_t r) { return border_of(r, h); };
  for (std::size_t y = 0; y < h; ++y) {
    double sum = 0;
    for (std::size_t x = 0; x < w; ++x) sum += cells[y * w + x];
    row_weights[y] = sum * (border(y + 1) - border(y));
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
