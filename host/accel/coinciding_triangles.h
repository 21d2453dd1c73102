#pragma once
// Triangles that lie in one another: which of them a ray hits first is decided by rounding.
#include <functional>
#include <optional>
#include <vector>

#include "accel/binary_bvh.h"
#include "accel/triangle_pairs.h"

namespace facet {

/// Whether two triangles lie in one plane, within the distance that a ray's origin is moved off a
/// surface (docs/reference/sampling.md, "Ray offset") on each of both, and have a common area: not
/// an edge or a corner alone.
[[nodiscard]] bool coincide(const TriangleCorners& a, const TriangleCorners& b);

/// Triangles that can be asked which of them coincide with another.
class CoincidenceFinder {
 public:
  explicit CoincidenceFinder(std::vector<TriangleCorners> triangles);

  /// Calls `found` with the index of each triangle that coincides with the other one, in no certain
  /// order. Looks at no more than so many triangles whose boxes the other's meets: where very many
  /// boxes overlap, some that coincide may not be found.
  void find(const TriangleCorners& other, std::size_t most_looked_at,
            const std::function<void(std::size_t)>& found) const;

 private:
  std::vector<TriangleCorners> triangles_;
  std::optional<BinaryBvh> tree_;  ///< none over no triangles
};

}  // namespace facet
