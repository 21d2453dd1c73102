#include "bust.h"

#include "bust_parts.h"
#include "distance.h"
#include "surface_nets.h"

namespace facet::generate {
namespace {

/// World units per unit of the sculpture.
constexpr double scale = 0.37;

double bust_distance(const Hair& hair, Vec3 p) {
  double d = drapery_distance(p);
  if (p.y < -2.2) d = join(d, socle_distance(p), 0.04);
  if (p.y > -2.0) d = join(d, face_distance(p), 0.04);
  if (p.y > -1.8) d = join(d, hair.distance(p), 0.015);
  if (p.y > 0.3) d = join(d, kalathos_distance(p), 0.02);
  return d;
}

/// Fine where the face and the beard are, coarse on the breast and the back.
Grid sculpture_grid() {
  constexpr double coarse = 0.042;
  constexpr double fine = 0.0182;
  const auto between = [](double t) { return coarse + (fine - coarse) * t; };
  Grid grid;
  grid.x = make_stations(
      -1.5, 1.5, [&](double x) { return between(1.0 - smooth_step(0.55, 1.0, std::abs(x))); });
  grid.y = make_stations(socle_bottom - 0.08, 1.95, [&](double y) {
    return between(smooth_step(-1.7, -1.2, y) * (1.0 - 0.7 * smooth_step(0.8, 1.0, y)));
  });
  grid.z = make_stations(-1.2, 1.15, [&](double z) { return between(smooth_step(-0.3, 0.35, z)); });
  return grid;
}

}  // namespace

Mesh make_bust() {
  const Hair hair;
  Mesh mesh = polygonise([&hair](Vec3 p) { return bust_distance(hair, p); }, sculpture_grid());
  for (Vec3& p : mesh.positions) p = (p - Vec3{0, socle_bottom, -0.12}) * scale;
  map_cylindrically(mesh);
  return mesh;
}

}  // namespace facet::generate
