// How environments and textures lie in the world, as in Nori.
#include <cmath>
#include <numbers>

#include "image/files.h"
#include "unit/orientation.h"

namespace facet::test {
namespace {

using ImageOrientation = OrientationTest;

/// An image of which no two texels are alike.
Image distinct_texels(int w, int h) {
  Image image(w, h, {"R", "G", "B"});
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      image.at(x, y, 0) = 0.1F + 0.08F * static_cast<float>(x);
      image.at(x, y, 1) = 0.9F - 0.2F * static_cast<float>(y);
      image.at(x, y, 2) = static_cast<float>((5 * x + 3 * y) % 7) / 8;
    }
  }
  return image;
}

/// Nori's lookup: texel (i, j) has its value at image coordinates (i, j).
Color lookup(const Image& image, double x, double y, bool wraps_in_y) {
  const auto i = static_cast<int>(std::floor(x));
  const auto j = static_cast<int>(std::floor(y));
  Color sum(0);
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const double weight = (dx == 1 ? x - i : 1 - (x - i)) * (dy == 1 ? y - j : 1 - (y - j));
      const int row = wraps_in_y ? (j + dy) % image.height() : std::min(j + dy, image.height() - 1);
      sum += static_cast<float>(weight) * pixel(image, (i + dx) % image.width(), row);
    }
  }
  return sum;
}

TEST_F(ImageOrientation, an_environment_lies_around_the_scene_as_in_nori) {
  const Image map = distinct_texels(8, 4);
  write_exr(folder_.file("sky.exr"), map);
  folder_.write("speck.obj", "v 0 9 0\nv 0.001 9 0\nv 0 9 0.001\nf 1 2 3\n");
  const std::string sky =
      "<emitter type=\"environment\"><string name=\"filename\" value=\"sky.exr\"/><string "
      "name=\"encoding\" "
      "value=\"linear\"/></emitter><mesh type=\"obj\"><string name=\"filename\" "
      "value=\"speck.obj\"/></mesh>";
  constexpr int side = 24;
  // Ahead, behind, to both sides and to both poles.
  const std::array<dvec3, 6> directions{dvec3(0, 0, 1),       dvec3(0, 0, -1),
                                        dvec3(1, 0, 0),       dvec3(-1, 0, 0),
                                        dvec3(0.01, 1, 0.02), dvec3(0.02, -1, 0.01)};
  for (const dvec3& target : directions) {
    const dvec3 up_hint = std::abs(target.y) > 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    const Scene scene = read(
        sky + camera(side, side, 80,
                     fmt::format("<lookat origin=\"0 0 0\" target=\"{} {} {}\" up=\"{} {} {}\"/>",
                                 target.x, target.y, target.z, up_hint.x, up_hint.y, up_hint.z)));
    const dvec3 ahead = glm::normalize(target);
    const dvec3 right = glm::normalize(glm::cross(ahead, up_hint));
    const dvec3 up = glm::cross(right, ahead);
    const double tangent = std::tan(40 * std::numbers::pi / 180);
    // Where the slope of the interpolation is steep, a filter of a hundredth of a pixel shows: 64
    // samples.
    for (const Image& image : images_of(scene, whole_image(scene, 64))) {
      double worst = 0;
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const dvec3 d = glm::normalize(ahead + (2 * (x + 0.5) / side - 1) * tangent * right +
                                         (1 - 2 * (y + 0.5) / side) * tangent * up);
          double u = std::atan2(d.z, d.x) / (2 * std::numbers::pi);
          if (u < 0) u += 1;
          const double v = std::acos(d.y) / std::numbers::pi;
          const Color expected = lookup(map, (1 - u) * map.width(), (1 - v) * map.height(), false);
          const Color found = pixel(image, x, y);
          for (int c = 0; c < 3; ++c)
            worst = std::max(worst, static_cast<double>(std::abs(expected[c] - found[c])));
        }
      }
      // Near a pole a hundredth of a pixel is a large part of the way around it.
      EXPECT_LT(worst, std::abs(target.y) > 0.5 ? 0.05 : 2e-3)
          << target.x << " " << target.y << " " << target.z;
    }
  }
}

TEST_F(ImageOrientation, a_textmap_lies_on_its_surface_as_in_nori) {
  Image map = distinct_texels(5, 3);
  write_png(folder_.file("map.png"), map, 0);
  map = read_image(folder_.file("map.png"));
  // The same values as floats.
  write_exr(folder_.file("map.exr"), map);
  folder_.write("quad.obj",
                "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 4/4 3/3 "
                "2/2 1/1\n");
  for (const std::string file : {"map.png", "map.exr"}) {
    SCOPED_TRACE(file);
    const Scene scene = read(
        "<mesh type=\"obj\"><string name=\"filename\" value=\"quad.obj\"/><emitter "
        "type=\"area\"><texture "
        "type=\"textmap\" "
        "name=\"radiance\"><string name=\"filename\" value=\"" +
        file +
        "\"/><boolean name=\"srgb\" "
        "value=\"true\"/></texture></emitter></mesh>" +
        camera(40, 40, 40, "<lookat origin=\"0 0 -3\" target=\"0 0 0\" up=\"0 1 0\"/>"));
    const double tangent = std::tan(20 * std::numbers::pi / 180);
    for (const Image& image : images_of(scene, whole_image(scene, 16))) {
      int compared = 0;
      double worst = 0;
      for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) {
          // Seen from -z, the world's x runs to the left.
          const double px = -3 * (2 * (x + 0.5) / 40 - 1) * tangent;
          const double py = 3 * (1 - 2 * (y + 0.5) / 40) * tangent;
          if (std::abs(px) > 0.99 || std::abs(py) > 0.99) continue;
          const double u = (px + 1) / 2;
          const double v = (py + 1) / 2;
          const Color expected = lookup(map, (1 - u) * map.width(), (1 - v) * map.height(), true);
          for (int c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(static_cast<double>(expected[c]) - image.at(x, y, c)));
          ++compared;
        }
      }
      EXPECT_GT(compared, 1000);
      EXPECT_LT(worst, 4e-3);
    }
  }
}

// Offsets of samples are as likely to the left as to the right, and upwards as downwards: a ramp
// shows its value at the pixel's centre.
}  // namespace
}  // namespace facet::test
