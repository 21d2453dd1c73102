#include "statistics/direction_bins.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace facet::statistics {

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::uint32_t cells_per_bin = 4;

double coordinate(const Coordinates& c, int axis) { return axis == 0 ? c.v : c.phi; }

/// Where to cut so that the share `below` of the samples lies below; the middle without samples.
double find_split(const Rectangle& area, std::span<Coordinates> pilots, double below, int axis) {
  const auto a = static_cast<std::size_t>(axis);
  const double middle = 0.5 * (area.lower[a] + area.upper[a]);
  if (pilots.size() < 2) return middle;
  const auto less = [&](const Coordinates& x, const Coordinates& y) {
    return coordinate(x, axis) < coordinate(y, axis);
  };
  const auto at = std::clamp<std::size_t>(
      static_cast<std::size_t>(below * static_cast<double>(pilots.size())), 1, pilots.size() - 1);
  const auto nth = pilots.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(pilots.begin(), nth, pilots.end(), less);
  const double split =
      0.5 * (coordinate(*nth, axis) + coordinate(*std::max_element(pilots.begin(), nth, less), axis));
  return split > area.lower[a] && split < area.upper[a] ? split : middle;
}

/// Both sides of a cut.
struct Halves {
  std::array<Rectangle, 2> area;
  std::array<std::span<Coordinates>, 2> pilots;
};

Halves cut(const Rectangle& area, std::span<Coordinates> pilots, int axis, double split) {
  const auto middle = std::partition(pilots.begin(), pilots.end(),
                                     [&](const Coordinates& c) { return coordinate(c, axis) < split; });
  const auto count = static_cast<std::size_t>(middle - pilots.begin());
  Halves halves{{area, area}, {pilots.first(count), pilots.subspan(count)}};
  halves.area[0].upper[static_cast<std::size_t>(axis)] = split;
  halves.area[1].lower[static_cast<std::size_t>(axis)] = split;
  return halves;
}

}  // namespace

DirectionBins::DirectionBins(const vec3& wo, std::span<const vec3> pilots, std::uint32_t bins) {
  const double radius = std::hypot(static_cast<double>(wo.x), static_cast<double>(wo.y));
  if (radius > 0) {
    axis_x_ = -static_cast<double>(wo.x) / radius;
    axis_y_ = -static_cast<double>(wo.y) / radius;
  }
  std::vector<Coordinates> points;
  points.reserve(pilots.size());
  for (const vec3& w : pilots) points.push_back(coordinates(w));
  const auto above =
      std::partition(points.begin(), points.end(), [](const Coordinates& c) { return c.side == 0; });
  const std::span<Coordinates> all(points);
  const auto upper = static_cast<std::size_t>(above - points.begin());
  const double share = points.empty() ? 1 : static_cast<double>(upper) / static_cast<double>(points.size());
  const auto upper_bins = std::clamp<std::uint32_t>(static_cast<std::uint32_t>(std::lround(share * bins)), 1,
                                                    std::max(2U, bins) - 1);
  roots_[0] = add_node({0, {0, -pi}, {1, pi}}, all.first(upper), upper_bins, 1);
  // What the upper side does not need; one where nothing goes down.
  roots_[1] = add_node({1, {0, -pi}, {1, pi}}, all.subspan(upper), bins - upper_bins, 1);
}

std::uint32_t DirectionBins::add_node(const Rectangle& area, std::span<Coordinates> pilots,
                                      std::uint32_t bins, int axis) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  if (bins <= 1) {
    nodes_[index].below = bin_count_++;
    add_cells(area, pilots, cells_per_bin, axis);
    return index;
  }
  const std::uint32_t below = bins / 2;
  const double split = find_split(area, pilots, static_cast<double>(below) / bins, axis);
  const Halves halves = cut(area, pilots, axis, split);
  const std::uint32_t first = add_node(halves.area[0], halves.pilots[0], below, 1 - axis);
  const std::uint32_t second = add_node(halves.area[1], halves.pilots[1], bins - below, 1 - axis);
  nodes_[index] = {axis, split, first, second};
  return index;
}

void DirectionBins::add_cells(const Rectangle& area, std::span<Coordinates> pilots, std::uint32_t count,
                              int axis) {
  if (count <= 1) {
    cells_.push_back({area, bin_count_ - 1, {pilots.begin(), pilots.end()}});
    return;
  }
  const Halves halves = cut(area, pilots, axis, find_split(area, pilots, 0.5, axis));
  for (std::size_t i = 0; i < 2; ++i) add_cells(halves.area[i], halves.pilots[i], count / 2, 1 - axis);
}

Coordinates DirectionBins::coordinates(const vec3& w) const {
  const double x = w.x;
  const double y = w.y;
  const double height = std::abs(static_cast<double>(w.z));
  Coordinates c;
  c.side = w.z >= 0 ? 0 : 1;
  // 1 - |z| cancels near the pole; the other form carries the rounding of x and y where z is small.
  c.v = height > 0.5 ? (x * x + y * y) / (1 + height) : 1 - height;
  c.phi = std::atan2(y * axis_x_ - x * axis_y_, x * axis_x_ + y * axis_y_);
  return c;
}

vec3 DirectionBins::direction(const Coordinates& c) const {
  const double radius = std::sqrt(c.v * (2 - c.v));
  const double along = radius * std::cos(c.phi);
  const double across = radius * std::sin(c.phi);
  const double z = c.side == 0 ? 1 - c.v : c.v - 1;
  return {static_cast<float>(along * axis_x_ - across * axis_y_),
          static_cast<float>(along * axis_y_ + across * axis_x_), static_cast<float>(z)};
}

std::uint32_t DirectionBins::bin_of(const vec3& w) const {
  const Coordinates c = coordinates(w);
  const Node* node = &nodes_[roots_[static_cast<std::size_t>(c.side)]];
  while (node->axis >= 0) node = &nodes_[coordinate(c, node->axis) < node->split ? node->below : node->above];
  return node->below;
}

}  // namespace facet::statistics
