#include "render/pack/emitter_pieces.h"

#include <cmath>
#include <optional>

#include "accel/triangle_pairs.h"

namespace facet {

namespace {

/// Largest difference of two areas that count as equal, relative to the larger.
constexpr double equal_areas = 1e-3;

/// The corners that an edge misses which two triangles go along in opposite directions.
struct MissedCorners {
  std::uint32_t first;
  std::uint32_t second;
};

std::optional<MissedCorners> across_common_edge(const TriangleCorners& first,
                                                const TriangleCorners& second) {
  for (std::uint32_t i = 0; i < 3; ++i) {
    for (std::uint32_t j = 0; j < 3; ++j) {
      if (first.at((i + 1) % 3) == second.at((j + 2) % 3) &&
          first.at((i + 2) % 3) == second.at((j + 1) % 3))
        return MissedCorners{i, j};
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<EmitterPiece> emitter_pieces(const Mesh& mesh) {
  std::vector<EmitterPiece> pieces;
  for (std::size_t i = 0; i < mesh.position_indices.size(); ++i) {
    const double area = triangle_area(mesh, i);
    pieces.push_back({area, area});
    if (i == 0) continue;
    EmitterPiece& before = pieces[i - 1];
    const double larger = std::max(before.area, area);
    const bool free = before.corner == shared::NO_CORNER && before.area > 0 && area > 0;
    if (!free || std::abs(before.area - area) > equal_areas * larger) continue;
    const auto corners =
        across_common_edge(triangle_corners(mesh, i - 1), triangle_corners(mesh, i));
    if (!corners) continue;
    before.weight = 0;
    before.corner = corners->first | shared::FIRST_OF_TWO;
    pieces[i].weight += before.area;
    pieces[i].corner = corners->second;
  }
  return pieces;
}

}  // namespace facet
