#pragma once

#include <functional>
#include <vector>

#include "mesh.h"

namespace facet::generate {

/// A field that is negative inside a body, zero on its surface, and grows by at most about 1.5 per
/// unit of length.
using Field = std::function<double(Vec3)>;

/// The stations of a rectilinear grid, ascending along each axis; closer together where the surface
/// has finer relief.
struct Grid {
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> z;
};

/// Stations from `low` to `high` whose distance at `c` is about `spacing(c)`.
std::vector<double> make_stations(double low, double high,
                                  const std::function<double(double)>& spacing);

/// The zero surface of the field as triangles, by naive surface nets (Gibson 1998): one vertex in
/// each cell that the surface crosses, moved onto the surface; one quadrilateral around each grid
/// edge that it crosses. Normals are the field's gradient. The surface must not reach the grid's
/// border.
Mesh polygonise(const Field& field, const Grid& grid);

}  // namespace facet::generate
