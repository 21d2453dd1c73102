#include "statistics/sphere_histogram.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace facet::statistics {

namespace {

constexpr double two_pi = 6.283185307179586;
/// GridCells are quartered at least so often, and at most.
constexpr int least_depth = 2;
constexpr int most_depth = 44;
/// A cell is done when quartering it changes its integral by less: samples, and share of the
/// integral.
constexpr double tolerated_samples = 0.05;
constexpr double tolerated_share = 1e-5;
/// GridCells with more of the points than this share (and more than a few) are quartered.
constexpr double guiding_share = 5e-4;
constexpr double guiding_points = 50;
/// Directions in one call of the density, and in all.
constexpr std::size_t directions_per_call = 9U << 16U;
constexpr std::size_t most_directions = std::size_t{1} << 27U;

/// A rectangle in (cos theta, phi), and the points in it.
struct GridCell {
  std::size_t bin = 0;
  std::array<double, 2> cosine{};
  std::array<double, 2> phi{};
  std::size_t first = 0;
  std::size_t end = 0;
  double integral = 0;
};

using GridCells = std::vector<GridCell>;

double between(const std::array<double, 2>& interval, double t) {
  return interval[0] + t * (interval[1] - interval[0]);
}

/// Abscissae and weights of three-point Gauss-Legendre quadrature on [0, 1].
constexpr std::array<double, 3> abscissae{0.1127016653792583, 0.5, 0.8872983346207417};
constexpr std::array<double, 3> weights{5.0 / 18, 8.0 / 18, 5.0 / 18};

void append_directions(const GridCell& cell, std::vector<vec3>& directions) {
  for (const double s : abscissae) {
    const double z = between(cell.cosine, s);
    const double sine = std::sqrt((1 - z) * (1 + z));
    for (const double t : abscissae) {
      const double phi = between(cell.phi, t);
      directions.emplace_back(sine * std::cos(phi), sine * std::sin(phi), z);
    }
  }
}

double weighted_sum(const GridCell& cell, std::span<const double, 9> densities) {
  double sum = 0;
  for (std::size_t i = 0; i < 9; ++i) sum += weights[i / 3] * weights[i % 3] * densities[i];
  return sum * (cell.cosine[1] - cell.cosine[0]) * (cell.phi[1] - cell.phi[0]);
}

/// Sets the cells' integrals.
void integrate(GridCells& cells, const Density& density) {
  constexpr std::size_t cells_per_call = directions_per_call / 9;
  for (std::size_t begin = 0; begin < cells.size(); begin += cells_per_call) {
    const std::size_t end = std::min(cells.size(), begin + cells_per_call);
    std::vector<vec3> directions;
    directions.reserve(9 * (end - begin));
    for (std::size_t i = begin; i < end; ++i) append_directions(cells[i], directions);
    const std::vector<double> densities = density(directions);
    for (std::size_t i = begin; i < end; ++i)
      cells[i].integral =
          weighted_sum(cells[i], std::span<const double, 9>(&densities[9 * (i - begin)], 9));
  }
}

/// Appends the cell's quarters, which share out its points.
void quarter(const GridCell& cell, std::vector<SpherePoint>& points, GridCells& quarters) {
  const auto at = [&](std::size_t i) { return points.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto index = [&](auto i) { return static_cast<std::size_t>(i - points.begin()); };
  const double z = between(cell.cosine, 0.5);
  const double phi = between(cell.phi, 0.5);
  const auto is_left = [phi](const SpherePoint& p) { return p.phi < phi; };
  const std::size_t half = index(std::partition(
      at(cell.first), at(cell.end), [z](const SpherePoint& p) { return p.cosine < z; }));
  const std::size_t low = index(std::partition(at(cell.first), at(half), is_left));
  const std::size_t high = index(std::partition(at(half), at(cell.end), is_left));
  quarters.push_back({cell.bin, {cell.cosine[0], z}, {cell.phi[0], phi}, cell.first, low});
  quarters.push_back({cell.bin, {cell.cosine[0], z}, {phi, cell.phi[1]}, low, half});
  quarters.push_back({cell.bin, {z, cell.cosine[1]}, {cell.phi[0], phi}, half, high});
  quarters.push_back({cell.bin, {z, cell.cosine[1]}, {phi, cell.phi[1]}, high, cell.end});
}

/// The bins as cells; sorts the points by them. A bin that straddles the horizon, where densities
/// end, becomes two cells.
GridCells root_cells(const SphereHistogram& h, std::vector<SpherePoint>& points) {
  const auto key = [&h](const SpherePoint& p) {
    return std::pair(h.bin(p.cosine, p.phi), p.cosine >= 0);
  };
  std::sort(points.begin(), points.end(),
            [&](const auto& a, const auto& b) { return key(a) < key(b); });
  GridCells cells;
  std::size_t next = 0;
  const auto add = [&](std::size_t bin, double bottom, double top, const std::array<double, 2>& phi,
                       bool below) {
    const std::size_t first = next;
    while (next < points.size() && key(points[next]).first == bin &&
           (!below || points[next].cosine < 0))
      ++next;
    cells.push_back({bin, {bottom, top}, phi, first, next});
  };
  for (std::size_t bin = 0; bin < h.expected.size(); ++bin) {
    const auto row = static_cast<int>(bin / static_cast<std::size_t>(h.columns));
    const auto column = static_cast<int>(bin % static_cast<std::size_t>(h.columns));
    const double bottom = 2.0 * row / h.rows - 1;
    const double top = 2.0 * (row + 1) / h.rows - 1;
    const std::array<double, 2> phi{two_pi * column / h.columns, two_pi * (column + 1) / h.columns};
    const bool straddles = bottom < 0 && top > 0;
    if (straddles) add(bin, bottom, 0, phi, true);
    add(bin, straddles ? 0 : bottom, top, phi, false);
  }
  return cells;
}

}  // namespace

SphereHistogram::SphereHistogram(int row_count, int column_count)
    : rows(row_count), columns(column_count) {
  const auto bins = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  observed.resize(bins);
  expected.resize(bins);
}

std::size_t SphereHistogram::bin(double cosine, double phi) const {
  const auto row = static_cast<int>(std::floor((cosine + 1) / 2 * rows));
  const auto column = static_cast<int>(std::floor(phi / two_pi * columns));
  return static_cast<std::size_t>(std::clamp(row, 0, rows - 1)) *
             static_cast<std::size_t>(columns) +
         static_cast<std::size_t>(std::clamp(column, 0, columns - 1));
}

SpherePoint sphere_point(const vec3& direction) {
  const double x = direction.x;
  const double y = direction.y;
  const double z = direction.z;
  double phi = std::atan2(y, x);
  if (phi < 0) phi += two_pi;
  // z / length, and where that is near 1 the sine is known better.
  const double sine_squared = x * x + y * y;
  const double cosine =
      z * z > sine_squared ? std::copysign(std::sqrt(std::max(0.0, 1 - sine_squared)), z) : z;
  return {cosine, std::min(phi, std::nextafter(two_pi, 0.0))};
}

bool integrate_expected(SphereHistogram& histogram, const Density& density,
                        std::vector<SpherePoint> points) {
  const double n = histogram.samples;
  const double many_points =
      std::max(guiding_points, guiding_share * static_cast<double>(points.size()));
  std::fill(histogram.expected.begin(), histogram.expected.end(), 0.0);
  GridCells cells = root_cells(histogram, points);
  integrate(cells, density);
  std::size_t directions = 0;
  for (int depth = 0; !cells.empty(); ++depth) {
    GridCells quarters;
    quarters.reserve(4 * cells.size());
    for (const GridCell& cell : cells) quarter(cell, points, quarters);
    directions += 9 * quarters.size();
    if (directions > most_directions) return false;
    integrate(quarters, density);
    GridCells next;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::span<const GridCell, 4> four(&quarters[4 * i], 4);
      const double sum = four[0].integral + four[1].integral + four[2].integral + four[3].integral;
      const double change = std::abs(sum - cells[i].integral);
      const bool guided = static_cast<double>(cells[i].end - cells[i].first) > many_points;
      const bool rough = change > tolerated_samples / n + tolerated_share * std::abs(sum);
      if (depth < least_depth || (depth < most_depth && (guided || rough))) {
        next.insert(next.end(), four.begin(), four.end());
      } else {
        histogram.expected[cells[i].bin] += n * sum;
      }
    }
    cells = std::move(next);
  }
  return true;
}

}  // namespace facet::statistics
