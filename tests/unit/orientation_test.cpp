// Where things lie in an image, from first principles: what kernels and reference have in common,
// parity cannot see. Everything expected here is worked out in this file, from Nori's conventions,
// not from facet's code.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "image/files.h"
#include "scene/reader.h"
#include "support/input.h"
#include "support/render.h"

namespace facet::test {
namespace {

/// Images of a scene by kernels and by the reference.
std::array<Image, 2> images_of(const Scene& scene, const RenderSettings& settings) {
  return {render(scene, settings).image,
          develop(render_reference(scene, settings, Precision::double_), false)};
}

Color pixel(const Image& image, int x, int y) {
  return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

/// A filter so narrow that a sample is its pixel's centre.
constexpr const char* narrow_filter =
    "<rfilter type=\"gaussian\"><float name=\"radius\" value=\"0.01\"/><float name=\"stddev\" "
    "value=\"0.01\"/></rfilter>";

std::string camera(int width, int height, double fov, const std::string& steps) {
  return fmt::format(
      "<camera type=\"perspective\"><integer name=\"width\" value=\"{}\"/><integer name=\"height\" "
      "value=\"{}\"/>"
      "<float name=\"fov\" value=\"{}\"/><transform name=\"toWorld\">{}</transform>{}</camera>",
      width, height, fov, steps, narrow_filter);
}

/// A square of side 1 around (x, y, 0), bright towards negative z.
struct Square {
  double x;
  double y;
  Color color;

  [[nodiscard]] bool holds(const dvec3& p) const {
    return std::abs(p.x - x) < 0.5 && std::abs(p.y - y) < 0.5;
  }
};

const std::array squares{Square{-1.2, 0.3, {1, 0, 0}}, Square{0.4, 1.1, {0, 1, 0}},
                         Square{1.3, -0.6, {0, 0, 1}}};

class Orientation : public ::testing::Test {
 protected:
  [[nodiscard]] Scene read(const std::string& content) const {
    Diagnostics diagnostics;
    return read_scene(folder_.write("scene.xml", "<scene><integrator type=\"direct_mats\"/>" +
                                                     content + "</scene>"),
                      diagnostics);
  }
  [[nodiscard]] Scene squares_seen_by(const std::string& camera_text) const {
    std::string meshes;
    for (const Square& s : squares) {
      const std::string name = fmt::format("{}.obj", s.color.r + 2 * s.color.g + 3 * s.color.b);
      folder_.write(name,
                    fmt::format("v {0} {1} 0\nv {0} {3} 0\nv {2} {3} 0\nv {2} {1} 0\nf 1 2 3 4\n",
                                s.x - 0.5, s.y - 0.5, s.x + 0.5, s.y + 0.5));
      meshes += fmt::format(
          "<mesh type=\"obj\"><string name=\"filename\" value=\"{}\"/><emitter type=\"area\">"
          "<color name=\"radiance\" value=\"{} {} {}\"/></emitter></mesh>",
          name, s.color.r, s.color.g, s.color.b);
    }
    return read(camera_text + meshes);
  }

  TemporaryFolder folder_;
};

constexpr int width = 60;
constexpr int height = 44;
constexpr double fov = 50;

/// What a viewer sees: from `eye`, looking along `ahead`, with `right` to the right of the image
/// and `up` to its top.
void expect_view(const Scene& scene, const dvec3& eye, const dvec3& ahead, const dvec3& right,
                 const dvec3& up) {
  const double tangent = std::tan(fov * std::numbers::pi / 360);
  std::array<int, 3> seen{};
  for (const Image& image : images_of(scene, whole_image(scene, 1))) {
    int wrong = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double across = (2 * (x + 0.5) / width - 1) * tangent;
        const double upwards = (1 - 2 * (y + 0.5) / height) * tangent * height / width;
        const dvec3 d = ahead + across * right + upwards * up;
        const dvec3 p = eye - eye.z / d.z * d;
        Color expected(0);
        for (std::size_t i = 0; i < squares.size(); ++i) {
          if (!squares.at(i).holds(p)) continue;
          expected = squares.at(i).color;
          ++seen.at(i);
        }
        if (pixel(image, x, y) != expected) ++wrong;
      }
    }
    // An edge may pass within rounding of a pixel's centre.
    EXPECT_LE(wrong, 2);
  }
  for (const int count : seen) EXPECT_GT(count, 40) << "every square is in the picture";
}

// Facing +z with y up, a person's right hand points to -x.
TEST_F(Orientation, a_bare_lookat_shows_the_world_unmirrored) {
  const Scene scene = squares_seen_by(camera(
      width, height, fov, "<lookat origin=\"0.1 0.2 -5\" target=\"0.1 0.2 0\" up=\"0 1 0\"/>"));
  expect_view(scene, {0.1, 0.2, -5}, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0});
}

TEST_F(Orientation, no_transform_at_all_looks_along_z_with_x_to_the_left) {
  const Scene scene =
      squares_seen_by(camera(width, height, fov, "<translate value=\"0.1 0.2 -5\"/>"));
  expect_view(scene, {0.1, 0.2, -5}, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0});
}

TEST_F(Orientation, scale_minus_1_mirrors) {
  const Scene scene = squares_seen_by(camera(width, height, fov,
                                             "<scale value=\"-1 1 1\"/><lookat origin=\"0.1 0.2 "
                                             "-5\" target=\"0.1 0.2 0\" up=\"0 1 0\"/>"));
  expect_view(scene, {0.1, 0.2, -5}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
}

TEST_F(Orientation, a_slanted_lookat_with_a_slanted_up) {
  const Scene scene = squares_seen_by(camera(
      width, height, fov, "<lookat origin=\"1 2 -5\" target=\"0.2 0.1 0\" up=\"0.3 1 0.1\"/>"));
  const dvec3 eye(1, 2, -5);
  const dvec3 ahead = glm::normalize(dvec3(0.2, 0.1, 0) - eye);
  const dvec3 right = glm::normalize(glm::cross(ahead, dvec3(0.3, 1, 0.1)));
  expect_view(scene, eye, ahead, right, glm::cross(right, ahead));
}

// A quarter turn about z takes x to y and y to -x: the camera's left is the world's up.
TEST_F(Orientation, rotate_turns_the_camera_as_a_right_hand_does) {
  const Scene scene = squares_seen_by(camera(
      width, height, fov, "<rotate angle=\"90\" axis=\"0 0 1\"/><translate value=\"0 0 -5\"/>"));
  expect_view(scene, {0, 0, -5}, {0, 0, 1}, {0, -1, 0}, {-1, 0, 0});
}

TEST_F(Orientation, a_matrix_has_the_cameras_axes_as_columns) {
  const Scene scene = squares_seen_by(
      camera(width, height, fov, "<matrix value=\"-1 0 0 0.3  0 1 0 0.1  0 0 1 -6  0 0 0 1\"/>"));
  expect_view(scene, {0.3, 0.1, -6}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
}

TEST_F(Orientation, a_crop_counts_from_the_upper_left_corner) {
  const Scene scene = squares_seen_by(camera(
      width, height, fov, "<lookat origin=\"0.1 0.2 -5\" target=\"0.1 0.2 0\" up=\"0 1 0\"/>"));
  RenderSettings settings = whole_image(scene, 1);
  const auto whole = images_of(scene, settings);
  settings.crop = {7, 5, 41, 30};
  const auto part = images_of(scene, settings);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(part.at(i).width(), 34);
    ASSERT_EQ(part.at(i).height(), 25);
    for (int y = 0; y < 25; ++y) {
      for (int x = 0; x < 34; ++x)
        EXPECT_EQ(pixel(part.at(i), x, y), pixel(whole.at(i), x + 7, y + 5));
    }
  }
}

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

TEST_F(Orientation, an_environment_lies_around_the_scene_as_in_nori) {
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

TEST_F(Orientation, a_textmap_lies_on_its_surface_as_in_nori) {
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
TEST_F(Orientation, pixel_centres_lie_half_a_pixel_from_the_corner) {
  const Scene scene = squares_seen_by(
      camera(2, 2, 90, "<lookat origin=\"-0.7 -0.2 -1\" target=\"-0.7 -0.2 0\" up=\"0 1 0\"/>"));
  // The four centres lie at (-0.7, -0.2) +- 0.5: red spans -1.7 to -0.7 and -0.2 to 0.8.
  for (const Image& image : images_of(scene, whole_image(scene, 1))) {
    EXPECT_EQ(pixel(image, 1, 0), Color(1, 0, 0)) << "right (-x) and up";
    EXPECT_EQ(pixel(image, 0, 0), Color(0));
    EXPECT_EQ(pixel(image, 0, 1), Color(0));
    EXPECT_EQ(pixel(image, 1, 1), Color(0));
  }
}

}  // namespace
}  // namespace facet::test
