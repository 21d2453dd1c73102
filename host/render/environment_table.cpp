#include "render/environment_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/choice.h"

namespace facet {

namespace {

/// Mean over each texel's cell of the bilinearly interpolated luminance: weights 1/8, 6/8, 1/8 along each
/// axis. It is positive wherever the interpolated value is, also where the texel itself is black.
std::vector<double> cell_luminances(const EnvironmentEmitter& e) {
  const auto w = static_cast<std::size_t>(e.width);
  const auto h = static_cast<std::size_t>(e.height);
  std::vector<double> along(w * h);
  std::vector<double> cells(w * h);
  for (std::size_t y = 0; y < h; ++y) {
    for (std::size_t x = 0; x < w; ++x) {
      const auto at = [&](std::size_t column) {
        return static_cast<double>(luminance(e.texels[y * w + column]));
      };
      along[y * w + x] = 0.125 * (at((x + w - 1) % w) + at((x + 1) % w)) + 0.75 * at(x);
    }
  }
  for (std::size_t y = 0; y < h; ++y) {
    for (std::size_t x = 0; x < w; ++x) {
      const auto at = [&](std::size_t row) { return along[row * w + x]; };
      cells[y * w + x] = 0.125 * (at(y > 0 ? y - 1 : 0) + at(std::min(y + 1, h - 1))) + 0.75 * at(y);
    }
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
  // Row r covers the directions whose y lies in [-cos(pi r/H), -cos(pi (r+1)/H)]: up is the last row.
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
    const double cell_angle = 2 * std::numbers::pi / static_cast<double>(w) * (border(y + 1) - border(y));
    for (std::size_t x = 0; x < w; ++x) {
      const double density = row_probability * choice_probability(counts, x) / cell_angle;
      table.texels.emplace_back(e.texels[y * w + x], static_cast<float>(density));
    }
  }
  return table;
}

}  // namespace facet
