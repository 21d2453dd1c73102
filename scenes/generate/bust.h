#pragma once

#include "mesh.h"

namespace facet::generate {

/// A stand-in for the lab's scan: the bust of a bearded god with a kalathos on his curls, draped,
/// on a round socle. It stands on y = 0, is about 2 high, has its axis near x = z = 0 and looks
/// along +z. More than 100,000 triangles.
Mesh make_bust();

}  // namespace facet::generate
