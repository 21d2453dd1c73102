// Textures of the reference, and the surfaces that they lie on.
#include <gtest/gtest.h>

#include "reference/texture.h"
#include "reference/tracer.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

using namespace reference;

template <typename Kind>
Vec3<double> value(const Kind& texture, double u, double v) {
  Unwatched probe;
  return texture_value(texture, Vec2<double>(u, v), 0, probe);
}

TEST(ReferenceTexture, checkers_alternate_on_both_sides_of_zero) {
  const CheckerTexture t{Color(1), Color(0), 4, 2};
  EXPECT_EQ(value(t, 0.1, 0.1).x, 1);
  EXPECT_EQ(value(t, 0.3, 0.1).x, 0);
  EXPECT_EQ(value(t, 0.3, 0.6).x, 1);
  EXPECT_EQ(value(t, 0.1, 0.6).x, 0);
  EXPECT_EQ(value(t, -0.1, 0.1).x, 0);
  EXPECT_EQ(value(t, -0.1, -0.1).x, 1);
  EXPECT_EQ(value(t, -0.3, -0.1).x, 0);
  EXPECT_EQ(value(t, 1e6 + 0.1, 0.1).x, 1);
  EXPECT_EQ(value(t, 0.25, 0).x, 0) << "a cell holds its lower border";
  EXPECT_EQ(value(t, 0, 0).x, 1);
}

/// Red counts the columns, green the rows, both in tenths.
BitmapTexture counting_map(int width, int height) {
  BitmapTexture t{width, height, {}, false, Color(1), 1, 1};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      t.texels.push_back(static_cast<std::uint32_t>(10 * x) | static_cast<std::uint32_t>(10 * y)
                                                                  << 8U);
  }
  return t;
}

TEST(ReferenceTexture, images_are_mirrored_in_u_and_begin_at_the_top) {
  const BitmapTexture t = counting_map(4, 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      const Vec3<double> texel = value(t, 1 - x / 4.0, 1 - y / 3.0);
      EXPECT_NEAR(texel.x * 255, 10 * x, 1e-5);
      EXPECT_NEAR(texel.y * 255, 10 * y, 1e-5);
      EXPECT_EQ(texel.z, 0);
    }
  }
}

TEST(ReferenceTexture, images_are_bilinear_and_repeat) {
  BitmapTexture t = counting_map(4, 3);
  EXPECT_NEAR(value(t, 1 - 0.5 / 4, 1).x * 255, 5, 1e-5) << "half way between two texels";
  EXPECT_NEAR(value(t, 1 - 0.25 / 4, 1).x * 255, 2.5, 1e-5);
  EXPECT_NEAR(value(t, 0.5 / 4, 1).x * 255, 15, 1e-5) << "the last column meets the first";
  EXPECT_NEAR(value(t, 1, 0.5 / 3).y * 255, 10, 1e-5) << "the last row meets the first";
  for (const double u : {0.1, 0.4, 0.95}) {
    for (const double v : {0.05, 0.5, 0.8}) {
      const Vec3<double> first = value(t, u, v);
      EXPECT_NEAR(glm::length(value(t, u - 3, v + 2) - first), 0, 1e-12);
      BitmapTexture twice = t;
      twice.scale_x = 2;
      twice.scale_y = -1;
      EXPECT_NEAR(glm::length(value(twice, u / 2, -v) - first), 0, 1e-12);
    }
  }
}

TEST(ReferenceTexture, bytes_are_decoded_and_tinted) {
  BitmapTexture t{1, 1, {188U << 8U | 255U}, false, Color(0.5F, 0.25F, 1), 1, 1};
  EXPECT_NEAR(value(t, 0.3, 0.3).x, 0.5, 1e-7);
  EXPECT_NEAR(value(t, 0.3, 0.3).y, 0.25 * 188 / 255, 1e-7);
  t.srgb = true;
  EXPECT_NEAR(value(t, 0.3, 0.3).x, 0.5, 1e-7);
  EXPECT_NEAR(value(t, 0.3, 0.3).y, 0.25 * std::pow((188.0 / 255 + 0.055) / 1.055, 2.4), 1e-7);
}

TEST(ReferenceTexture, roughness_is_luminance_within_its_range) {
  Unwatched probe;
  const std::vector<Texture> textures{CheckerTexture{Color(0.2F, 0.4F, 0.6F), Color(0)}};
  Textured<float> alpha;
  alpha.texture = 0;
  const auto roughness = [&](double u) {
    const Vec2<double> uv(u, 0);
    return Parameters<double, Unwatched>(textures, uv, probe).roughness(alpha);
  };
  EXPECT_NEAR(roughness(0.5), 0.2126 * 0.2 + 0.7152 * 0.4 + 0.0722 * 0.6, 1e-7);
  EXPECT_EQ(roughness(1.5), 1e-4);
}

/// A scene of one quad, whose lower left triangle is found by the weights (b1, b2).
Vec2<double> uv_of(Mesh mesh, double b1, double b2) {
  Unwatched probe;
  Scene scene = make_scene("path_mis");
  scene.textures.emplace_back(CheckerTexture{});
  add_mesh(scene, std::move(mesh), bsdf::Diffuse{});
  Triangle<double> triangle{};
  return surface_at(scene, triangle, b1, b2, probe).uv;
}

TEST(ReferenceTexture, coordinates_are_interpolated_or_the_weights) {
  Mesh quad = make_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  EXPECT_EQ(uv_of(quad, 0.25, 0.5), Vec2<double>(0.25, 0.5));
  quad.texcoords = {{2, 3}, {4, 3}, {4, 11}};
  quad.texcoord_indices = {{0, 1, 2}, {none, none, none}};
  EXPECT_EQ(uv_of(quad, 0.25, 0.5), Vec2<double>(2 + 2 * 0.75, 3 + 8 * 0.5));
  std::swap(quad.texcoord_indices[0], quad.texcoord_indices[1]);
  EXPECT_EQ(uv_of(quad, 0.25, 0.5), Vec2<double>(0.25, 0.5));
}

}  // namespace
}  // namespace facet::test
