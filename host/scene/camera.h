#pragma once
#include "core/maths.h"
#include "scene/filter.h"

namespace facet {

/* perspective: a pinhole camera.

   | parameter     | default     | meaning                                                              |
   |---------------|-------------|----------------------------------------------------------------------|
   | width, height | 1280, 720   | pixels                                                               |
   | fov           | 30          | angle of view along the image's width, degrees, above 0 and below 180 |
   | toWorld       | identity    | from the camera's space to the scene's                               |
   | nearClip      | 1e-4        | least depth that is seen                                             |
   | farClip       | 1e4         | greatest depth that is seen                                          |

   Holds one rfilter, by default `gaussian`. It looks along +z of its space, +x to the left of the
   image, +y up, as in Nori: a bare lookat (whose x is the viewer's left) shows the world as it is,
   and scale -1, 1, 1 mirrors it. Directions are single-precision: where a pixel is narrower than 32
   of their roundings and the camera is turned, edges lie beside their places, and facet warns. */
struct Camera {
  int width = 1280;
  int height = 720;
  dmat4 to_world{1};
  double fov = 30;  ///< degrees, along x
  double near_clip = 1e-4;
  double far_clip = 1e4;
  Filter filter;
};

}  // namespace facet
