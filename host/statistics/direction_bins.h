#pragma once
// Bins over all directions that are as small as a BSDF's lobes: each holds about as many samples.
#include <array>
#include <span>
#include <vector>

#include "statistics/bsdf_evaluator.h"

namespace facet::statistics {

/// A direction as height and azimuth, between which equal areas are equal solid angles: dw = dv
/// dphi.
struct Coordinates {
  int side = 0;    ///< 0: z >= 0, 1: below
  double v = 0;    ///< 1 - |z|, in [0, 1], exact near 0 and near 1
  double phi = 0;  ///< in [-pi, pi], from the azimuth opposite to wo
};

/// A rectangle in these coordinates.
struct Rectangle {
  int side = 0;
  std::array<double, 2> lower{};  ///< v, phi
  std::array<double, 2> upper{};
};

/// A sample that shows where the density is.
struct Pilot {
  Coordinates at;
  double pdf = 0;
};

/// A rectangle that lies within one bin, with the pilot samples that lie within it.
struct Cell {
  Rectangle area;
  std::uint32_t bin = 0;
  std::vector<Pilot> pilots;
};

/// A tree of rectangles over both hemispheres, split where pilot samples have their medians; z = 0
/// is a border.
class DirectionBins {
 public:
  /// wo: from which coordinates count; pilots: accepted samples.
  DirectionBins(const vec3& wo, std::span<const BsdfDraw> pilots, std::uint32_t bins);

  [[nodiscard]] Coordinates coordinates(const vec3& w) const;
  [[nodiscard]] vec3 direction(const Coordinates& c) const;

  [[nodiscard]] std::uint32_t bin_of(const vec3& w) const;
  [[nodiscard]] std::uint32_t bin_count() const { return bin_count_; }
  /// Parts of the bins, a few each.
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }

 private:
  struct Node {
    int axis = -1;  ///< 0: v, 1: phi; -1: a bin
    double split = 0;
    std::uint32_t below = 0;  ///< node, or the bin's number
    std::uint32_t above = 0;
  };

  std::uint32_t add_node(const Rectangle& area, std::span<Pilot> pilots, std::uint32_t bins,
                         int axis);
  void add_cell(const Rectangle& area, std::span<const Pilot> pilots);
  void add_frame(const Rectangle& outer, const Rectangle& inner, std::span<const Pilot> pilots);
  void add_cells(const Rectangle& area, std::span<Pilot> pilots, std::uint32_t count, int axis);

  double axis_x_ = 1;  ///< azimuth 0
  double axis_y_ = 0;
  std::uint32_t bin_count_ = 0;
  std::array<std::uint32_t, 2> roots_{};
  std::vector<Node> nodes_;
  std::vector<Cell> cells_;
};

}  // namespace facet::statistics
