#pragma once
// Where things lie in an image. Everything expected is worked out in the tests, from Nori's
// conventions, not from facet's code: what kernels and reference have in common, parity cannot see.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>

#include "scene/reader.h"
#include "support/input.h"
#include "support/render.h"

namespace facet::test {

/// Images of a scene by kernels and by the reference.
inline std::array<Image, 2> images_of(const Scene& scene, const RenderSettings& settings) {
  return {render(scene, settings).image,
          develop(render_reference(scene, settings, Precision::double_), false)};
}

inline Color pixel(const Image& image, int x, int y) {
  return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

/// A filter so narrow that a sample is its pixel's centre.
inline constexpr const char* narrow_filter =
    "<rfilter type=\"gaussian\"><float name=\"radius\" value=\"0.01\"/><float name=\"stddev\" "
    "value=\"0.01\"/></rfilter>";

inline std::string camera(int width, int height, double fov, const std::string& steps) {
  return fmt::format(
      "<camera type=\"perspective\"><integer name=\"width\" value=\"{}\"/><integer name=\"height\" "
      "value=\"{}\"/>"
      "<float name=\"fov\" value=\"{}\"/><transform name=\"toWorld\">{}</transform>{}</camera>",
      width, height, fov, steps, narrow_filter);
}

class OrientationTest : public ::testing::Test {
 protected:
  [[nodiscard]] Scene read(const std::string& content) const {
    Diagnostics diagnostics;
    return read_scene(folder_.write("scene.xml", "<scene><integrator type=\"direct_mats\"/>" +
                                                     content + "</scene>"),
                      diagnostics);
  }

  TemporaryFolder folder_;
};

}  // namespace facet::test
