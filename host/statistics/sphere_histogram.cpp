#include "statistics/sphere_histogram.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace facet::statistics {

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// In [0, 2 pi].
double turned_positive(double phi) { return phi < 0 ? phi + two_pi : phi; }

}  // namespace

SphereHistogram::SphereHistogram(int row_count, int column_count)
    : rows(row_count), columns(column_count) {
  const auto bins = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  observed.resize(bins);
  expected.resize(bins);
}

std::size_t SphereHistogram::bin(const Coordinates& direction) const {
  const auto row = static_cast<int>(std::floor((direction.cosine() + 1) / 2 * rows));
  const auto column =
      static_cast<int>(std::floor(turned_positive(direction.phi) / two_pi * columns));
  return static_cast<std::size_t>(std::clamp(row, 0, rows - 1)) *
             static_cast<std::size_t>(columns) +
         static_cast<std::size_t>(std::clamp(column, 0, columns - 1));
}

std::vector<Cell> SphereHistogram::cells(const std::vector<Pilot>& pilots) const {
  std::vector<Cell> list;
  // Of each bin, above and below the horizon.
  std::vector<std::array<std::size_t, 2>> index(observed.size());
  const auto add = [&](std::size_t bin, int side, double nearer, double farther) {
    const auto column = static_cast<int>(bin % static_cast<std::size_t>(columns));
    index[bin][static_cast<std::size_t>(side)] = list.size();
    list.push_back(
        {{side, {nearer, two_pi * column / columns}, {farther, two_pi * (column + 1) / columns}},
         static_cast<std::uint32_t>(bin),
         {}});
  };
  for (std::size_t bin = 0; bin < observed.size(); ++bin) {
    const auto row = static_cast<int>(bin / static_cast<std::size_t>(columns));
    const double bottom = 2.0 * row / rows - 1;
    const double top = 2.0 * (row + 1) / rows - 1;
    if (top > 0) add(bin, 0, 1 - top, 1 - std::max(bottom, 0.0));
    if (bottom < 0) add(bin, 1, 1 + bottom, 1 + std::min(top, 0.0));
  }
  for (Pilot p : pilots) {
    p.at.phi = turned_positive(p.at.phi);
    list[index[bin(p.at)][static_cast<std::size_t>(p.at.side)]].pilots.push_back(p);
  }
  return list;
}

}  // namespace facet::statistics
