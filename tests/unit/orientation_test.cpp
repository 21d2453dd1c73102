// Where a camera puts things in its image, from first principles.
#include "unit/orientation.h"

#include <cmath>
#include <numbers>

namespace facet::test {
namespace {

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

class Orientation : public OrientationTest {
 protected:
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
