#include "statistics/direction_bins.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace facet::statistics {

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::uint32_t cells_per_bin = 4;

double coordinate(const Coordinates& c, int axis) { return axis == 0 ? c.v : c.phi; }
double coordinate(const Pilot& p, int axis) { return coordinate(p.at, axis); }

/// Where to cut so that the share `below` of the samples lies below; the middle without samples.
double find_split(const Rectangle& area, std::span<Pilot> pilots, double below, int axis) {
  const auto a = static_cast<std::size_t>(axis);
  const double middle = 0.5 * (area.lower[a] + area.upper[a]);
  if (pilots.size() < 2) return middle;
  const auto less = [&](const Pilot& x, const Pilot& y) {
    return coordinate(x, axis) < coordinate(y, axis);
  };
  const auto at = std::clamp<std::size_t>(
      static_cast<std::size_t>(below * static_cast<double>(pilots.size())), 1, pilots.size() - 1);
  const auto nth = pilots.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(pilots.begin(), nth, pilots.end(), less);
  const double split = 0.5 * (coordinate(*nth, axis) +
                              coordinate(*std::max_element(pilots.begin(), nth, less), axis));
  return split > area.lower[a] && split < area.upper[a] ? split : middle;
}

/// Both sides of a cut.
struct Halves {
  std::array<Rectangle, 2> area;
  std::array<std::span<Pilot>, 2> pilots;
};

Halves cut(const Rectangle& area, std::span<Pilot> pilots, int axis, double split) {
  const auto middle = std::partition(pilots.begin(), pilots.end(),
                                     [&](const Pilot& p) { return coordinate(p, axis) < split; });
  const auto count = static_cast<std::size_t>(middle - pilots.begin());
  Halves halves{{area, area}, {pilots.first(count), pilots.subspan(count)}};
  halves.area[0].upper[static_cast<std::size_t>(axis)] = split;
  halves.area[1].lower[static_cast<std::size_t>(axis)] = split;
  return halves;
}

/// The bounding box of the samples where the density is within an eighth of the largest; the whole
/// area where there are hardly any.
Rectangle peak_box(const Rectangle& area, std::span<const Pilot> pilots) {
  if (pilots.size() < 2) return area;
  double largest = 0;
  for (const Pilot& p : pilots) largest = std::max(largest, p.pdf);
  Rectangle box{area.side, area.upper, area.lower};
  for (const Pilot& p : pilots) {
    if (8 * p.pdf < largest) continue;
    for (int axis = 0; axis < 2; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      box.lower[k] = std::min(box.lower[k], coordinate(p, axis));
      box.upper[k] = std::max(box.upper[k], coordinate(p, axis));
    }
  }
  return box;
}

bool contains(const Rectangle& area, const Coordinates& c) {
  return c.v >= area.lower[0] && c.v < area.upper[0] && c.phi >= area.lower[1] &&
         c.phi < area.upper[1];
}

/// The box with its own size added on every side, within the area.
Rectangle widened(const Rectangle& area, const Rectangle& box) {
  Rectangle wide = box;
  for (std::size_t k = 0; k < 2; ++k) {
    const double width = std::max(box.upper[k] - box.lower[k], 1e-9);
    wide.lower[k] = std::max(area.lower[k], box.lower[k] - width);
    wide.upper[k] = std::min(area.upper[k], box.upper[k] + width);
  }
  return wide;
}

}  // namespace

DirectionBins::DirectionBins(const vec3& wo, std::span<const BsdfDraw> pilots, std::uint32_t bins)
    : coordinates_(wo) {
  std::vector<Pilot> points;
  points.reserve(pilots.size());
  for (const BsdfDraw& d : pilots)
    points.push_back({coordinates_.of(d.wi), static_cast<double>(d.pdf)});
  const auto above =
      std::partition(points.begin(), points.end(), [](const Pilot& p) { return p.at.side == 0; });
  const std::span<Pilot> all(points);
  const auto upper = static_cast<std::size_t>(above - points.begin());
  const double share =
      points.empty() ? 1 : static_cast<double>(upper) / static_cast<double>(points.size());
  const auto upper_bins = std::clamp<std::uint32_t>(
      static_cast<std::uint32_t>(std::lround(share * bins)), 1, std::max(2U, bins) - 1);
  roots_[0] = add_node({0, {0, -pi}, {1, pi}}, all.first(upper), upper_bins, 1);
  // What the upper side does not need; one where nothing goes down.
  roots_[1] = add_node({1, {0, -pi}, {1, pi}}, all.subspan(upper), bins - upper_bins, 1);
}

std::uint32_t DirectionBins::add_node(const Rectangle& area, std::span<Pilot> pilots,
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

void DirectionBins::add_cells(const Rectangle& area, std::span<Pilot> pilots, std::uint32_t count,
                              int axis) {
  if (count > 1) {
    const Halves halves = cut(area, pilots, axis, find_split(area, pilots, 0.5, axis));
    for (std::size_t i = 0; i < 2; ++i)
      add_cells(halves.area[i], halves.pilots[i], count / 2, 1 - axis);
    return;
  }
  // A cell may be far larger than the part of a lobe in it. Around the densest samples it is cut
  // into frames, each three times as wide as the one within, so that no quadrature starts with
  // points that all lie far from where the mass is.
  Rectangle box = widened(area, peak_box(area, pilots));
  add_cell(box, pilots);
  while (box.lower != area.lower || box.upper != area.upper) {
    const Rectangle wide = widened(area, box);
    add_frame(wide, box, pilots);
    box = wide;
  }
}

void DirectionBins::add_cell(const Rectangle& area, std::span<const Pilot> pilots) {
  // Where light is refracted from a grazing direction, the density ends just before the horizon: no
  // step may lie between it and the first point.
  if (area.upper[0] == 1 && area.lower[0] < 1 - 1e-5) {
    Rectangle above = area;
    Rectangle horizon = area;
    above.upper[0] = horizon.lower[0] = 0.5 * (area.lower[0] + 1);
    add_cell(above, pilots);
    add_cell(horizon, pilots);
    return;
  }
  Cell cell{area, bin_count_ - 1, {}};
  std::ranges::copy_if(pilots, std::back_inserter(cell.pilots),
                       [&](const Pilot& p) { return contains(area, p.at); });
  cells_.push_back(std::move(cell));
}

void DirectionBins::add_frame(const Rectangle& outer, const Rectangle& inner,
                              std::span<const Pilot> pilots) {
  Rectangle rest = outer;
  for (std::size_t k = 0; k < 2; ++k) {
    Rectangle piece = rest;
    piece.upper[k] = rest.lower[k] = inner.lower[k];
    if (piece.upper[k] > piece.lower[k]) add_cell(piece, pilots);
    piece = rest;
    piece.lower[k] = rest.upper[k] = inner.upper[k];
    if (piece.upper[k] > piece.lower[k]) add_cell(piece, pilots);
  }
}

std::uint32_t DirectionBins::bin_of(const vec3& w) const {
  const Coordinates c = coordinates_.of(w);
  const Node* node = &nodes_[roots_[static_cast<std::size_t>(c.side)]];
  while (node->axis >= 0)
    node = &nodes_[coordinate(c, node->axis) < node->split ? node->below : node->above];
  return node->below;
}

}  // namespace facet::statistics
