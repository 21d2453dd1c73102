#include "scene/camera.h"

#include <glm/gtc/matrix_access.hpp>

#include "scene/xml/property_reader.h"

namespace facet {

void Camera::check(const PropertyReader& properties) const {
  if (static_cast<long long>(width) * height > largest_image_area) {
    properties.fail("width", fmt::format("and height make an image of {}x{}, more than {} pixels",
                                         width, height, largest_image_area));
  }
  if (glm::determinant(glm::dmat3(to_world)) == 0) properties.fail("toWorld", "is not invertible");
  if (glm::row(to_world, 3) != glm::dvec4(0, 0, 0, 1))
    properties.fail("toWorld", "is projective: its last row must be 0 0 0 1");
  if (!(far_clip > near_clip)) {
    properties.fail("farClip",
                    fmt::format("is {:g}, but must be greater than {:g}", far_clip, near_clip));
  }
}

}  // namespace facet
