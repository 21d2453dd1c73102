#pragma once
#include "image/files.h"
#include "scene/filter.h"

namespace facet {

/// Largest image that is rendered, pixels a side and in all: what is written can be read again.
inline constexpr int largest_image_side = static_cast<int>(largest_file_side);
inline constexpr long long largest_image_area = largest_file_area;

/* perspective: a pinhole camera.

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

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    using namespace parameter;
    visit("width", p.width, Count{1, largest_image_side}, "pixels");
    visit("height", p.height, Count{1, largest_image_side}, "pixels");
    visit("fov", p.fov, Inside{0, 180}, "angle of view along the image's width, degrees");
    visit("toWorld", p.to_world, Transform{}, "from the camera's space to the scene's");
    visit("nearClip", p.near_clip, AtLeast{0}, "least depth that is seen");
    visit("farClip", p.far_clip, Real{}, "greatest depth that is seen, more than nearClip");
  }
  /// Throws InputError where the image is too large, the clipping planes lie in the wrong order, or
  /// toWorld is not a transform that can be turned back.
  void check(const PropertyReader& properties) const;
};

}  // namespace facet
