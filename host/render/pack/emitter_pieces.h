#pragma once
// What an area emitter's mesh is sampled by (docs/reference/sampling.md, "Emitter sample").
#include <cstdint>
#include <vector>

#include "scene/scene.h"
#include "shared/records.h"

namespace facet {

/// One triangle of an emitter.
struct EmitterPiece {
  double area = 0;  ///< of the triangle
  double weight =
      0;  ///< of its choice; of two triangles that are sampled as one, the second has it
  std::uint32_t corner = shared::NO_CORNER;  ///< as in shared::EmitterTriangle
};

/// One for each triangle of the mesh, in order.
[[nodiscard]] std::vector<EmitterPiece> emitter_pieces(const Mesh& mesh);

}  // namespace facet
