#pragma once
// Bins over all directions that are as small as a BSDF's lobes: each holds about as many samples.
#include <span>

#include "statistics/density_integral.h"

namespace facet::statistics {

/// A tree of rectangles over both hemispheres, split where pilot samples have their medians; z = 0
/// is a border.
class DirectionBins {
 public:
  /// wo: from which coordinates count; pilots: accepted samples.
  DirectionBins(const vec3& wo, std::span<const BsdfDraw> pilots, std::uint32_t bins);

  /// In which the bins are rectangles.
  [[nodiscard]] const SphereCoordinates& coordinates() const { return coordinates_; }
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

  SphereCoordinates coordinates_;
  std::uint32_t bin_count_ = 0;
  std::array<std::uint32_t, 2> roots_{};
  std::vector<Node> nodes_;
  std::vector<Cell> cells_;
};

}  // namespace facet::statistics
