#pragma once

#include "curls.h"
#include "vec3.h"

/// The parts of the bust as signed distances. Units are those of the sculpture: the face is
/// about 1.7 high, the eyes are near y = 0.12, x runs to the god's left, y up, z out of the face.
/// Each part is defined everywhere.
namespace facet::generate {

/// Skull, brow, eyes, nose, mouth and neck.
double face_distance(Vec3 p);

/// Hair and beard: curls on the skull, five locks on the forehead, beard in two strands, moustache.
class Hair {
 public:
  Hair();
  double distance(Vec3 p) const;

 private:
  Curls curls_;
};

/// The grain measure on the head.
double kalathos_distance(Vec3 p);

/// Shoulders and breast in a folded chiton, the mantle over the left shoulder.
double drapery_distance(Vec3 p);

/// The turned foot beneath the breast.
double socle_distance(Vec3 p);

/// The lowest point of the socle.
constexpr double socle_bottom = -3.62;

}  // namespace facet::generate
