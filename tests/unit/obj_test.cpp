// Wavefront OBJ: what is accepted, and the line of what is not.
#include "support/obj.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/ext/matrix_transform.hpp>
#include <numbers>

namespace facet {

namespace {

using test::area;
using test::expect_message;
using test::input_error_of;
using test::ObjTest;
using test::place;
using test::square;

TEST_F(ObjTest, OneTriangle) {
  const Mesh mesh = read("# comment\nv 1 2 3\nv 4 5 6\nv 7 8 10\nf 1 2 3\n");
  EXPECT_EQ(mesh.positions, (std::vector<vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 10}}));
  EXPECT_EQ(mesh.position_indices, (std::vector<uvec3>{{0, 1, 2}}));
  EXPECT_TRUE(mesh.normal_indices.empty());
  EXPECT_TRUE(mesh.texcoord_indices.empty());
  EXPECT_EQ(mesh.name, "mesh.obj");
  EXPECT_EQ(mesh.emitter, none);
}

TEST_F(ObjTest, LargeFilesAreReadAsSmallOnes) {
  constexpr int count = 100'000;
  std::string text;
  for (int i = 0; i < count; ++i)
    text += fmt::format("v {} 0 0\nv {} 1 0\nv {} 0 1\nf -3 -2 {}\n", i, i, i, 3 * i + 3);
  const Mesh mesh = read(text);
  ASSERT_EQ(mesh.position_indices.size(), static_cast<std::size_t>(count));
  ASSERT_EQ(mesh.positions.size(), static_cast<std::size_t>(3 * count));
  for (std::uint32_t i = 0; i < count; ++i) {
    ASSERT_EQ(mesh.position_indices[i], uvec3(3 * i, 3 * i + 1, 3 * i + 2));
    ASSERT_EQ(mesh.positions[3 * std::size_t{i}], vec3(i, 0, 0));
  }
  // Of several errors the first is told, with its line.
  const std::string bad = text + "v 1 2\n" + text + text + "f 1 2\n" + text;
  expect_message(input_error_of([&] { read(bad); }), place(folder_.file("mesh.obj"), 4 * count + 1),
                 {"a vertex of 2 coordinates"});
}

TEST_F(ObjTest, NegativeIndicesCountFromTheEnd) {
  const Mesh mesh = read("v 9 9 9\n" + square + "f -4 -3 -2\nv 5 5 5\nf -1 1 2\n");
  EXPECT_EQ(mesh.position_indices, (std::vector<uvec3>{{1, 2, 3}, {5, 0, 1}}));
}

TEST_F(ObjTest, IndicesMayHaveASign) {
  EXPECT_EQ(read(square + "f +1 +2 -1\n").position_indices, (std::vector<uvec3>{{0, 1, 3}}));
  expect_error(square + "f +-1 2 3\n", 5, {"+-1"});
  expect_error(square + "f + 2 3\n", 5, {});
}

TEST_F(ObjTest, EveryKindOfCornerMayBeMixed) {
  const Mesh mesh = read(square +
                         "vt 0.25 0.75\nvt 1 0\nvn 0 0 2\n"
                         "f 1 2 3\nf 1/1 2/2 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/2/1 3/2/1\n");
  ASSERT_EQ(mesh.position_indices.size(), 4U);
  ASSERT_EQ(mesh.normal_indices.size(), 4U);
  ASSERT_EQ(mesh.texcoord_indices.size(), 4U);
  EXPECT_EQ(mesh.normal_indices[0].x, none);
  EXPECT_EQ(mesh.normal_indices[1].x, none);
  EXPECT_EQ(mesh.normal_indices[2], uvec3(0, 0, 0));
  EXPECT_EQ(mesh.texcoord_indices[0].x, none);
  EXPECT_EQ(mesh.texcoord_indices[1], uvec3(0, 1, 0));
  EXPECT_EQ(mesh.texcoord_indices[2].x, none);
  EXPECT_EQ(mesh.texcoord_indices[3], uvec3(0, 1, 1));
  EXPECT_EQ(mesh.texcoords, (std::vector<vec2>{{0.25F, 0.75F}, {1, 0}}));
  EXPECT_EQ(mesh.normals.at(0), vec3(0, 0, 1)) << "normals are made unit";
}

TEST_F(ObjTest, NormalsOfSomeCornersAreNone) {
  EXPECT_TRUE(read(square + "vn 0 0 1\nf 1//1 2 3//1\n").normal_indices.empty());
}

TEST_F(ObjTest, GroupsMaterialsAndLineEndingsDoNotMatter) {
  const std::string text =
      "mtllib none.mtl\r\no a\r\nv 0 0 0\r\nv\t1 0 0\r\nv 0 1 0 1.0\r\ng b\r\nusemtl c\r\ns 1\r\nf "
      "1 2 3";
  const Mesh mesh = read(text);
  EXPECT_EQ(mesh.position_indices, (std::vector<uvec3>{{0, 1, 2}}));
  EXPECT_EQ(mesh.positions.at(1), vec3(1, 0, 0));
}

TEST_F(ObjTest, AByteOrderMarkIsNoPartOfTheFirstLine) {
  const Mesh mesh = read("\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(mesh.positions.size(), 3U);
}

TEST_F(ObjTest, NormalsAreTransformedByTheInverseTranspose) {
  const dmat4 stretch = glm::scale(dmat4(1), dvec3(1, 4, 1));
  const Mesh mesh =
      read(square + "vn 1 1 0\nf 1//1 2//1 3//1\n", glm::translate(dmat4(1), dvec3(5)) * stretch);
  const vec3 expected = glm::normalize(vec3(1, 0.25F, 0));
  EXPECT_NEAR(mesh.normals.at(0).x, expected.x, 1e-6F);
  EXPECT_NEAR(mesh.normals.at(0).y, expected.y, 1e-6F);
  EXPECT_NEAR(mesh.normals.at(0).z, 0, 1e-6F);
  EXPECT_EQ(mesh.positions.at(2), vec3(6, 9, 5));
}

TEST_F(ObjTest, MirroringMirrorsNormals) {
  const Mesh mesh =
      read(square + "vn 1 0 0\nf 1//1 2//1 3//1\n", glm::scale(dmat4(1), dvec3(-1, 1, 1)));
  EXPECT_EQ(mesh.normals.at(0), vec3(-1, 0, 0));
}

TEST_F(ObjTest, AZeroNormalStaysZero) {
  EXPECT_EQ(read(square + "vn 0 0 0\nf 1//1 2//1 3//1\n").normals.at(0), vec3(0));
}

TEST_F(ObjTest, FilesWithoutFacesDrawAWarning) {
  for (const char* text : {"v 0 0 0\n", "# points\nv 0 0 0\np 1\n"}) {
    EXPECT_TRUE(read(text).position_indices.empty());
    expect_one_warning({"mesh.obj", "no faces"});
  }
}

TEST_F(ObjTest, CoordinatesMustBeFiniteNumbers) {
  expect_error("v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", 2, {"nan", "not a finite number"});
  expect_error("v 0 0 0\n\nv 0 inf 0\n", 3, {"inf", "not a finite number"});
  expect_error("v 0 0 zero\n", 1, {"zero", "not a finite number"});
  expect_error("v 0 0 1e999\n", 1, {"1e999", "not a finite number"});
  expect_error("v 0 0 -\n", 1, {"-", "not a finite number"});
  expect_error("v 0 0 1.2.3\n", 1, {"1.2.3", "not a finite number"});
  expect_error("v 0 0 1e\n", 1, {"1e", "not a finite number"});
  expect_error("v 0,5 0 0\n", 1, {"0,5", "not a finite number"});
  expect_error("v 0 0 1e99999999999\n", 1, {"1e99999999999", "not a finite number"});
  expect_error("v 0 0 1" + std::string(400, '0') + "\n", 1, {"not a finite number"});
  expect_error("v 0 0 1" + std::string(400, '0') + "e-400\n", 1, {"not a finite number"});
}

TEST_F(ObjTest, MissingCoordinatesAreErrors) {
  expect_error("v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n", 2, {});
  expect_error("v 0 0 0\nv\nv 0 1 0\nf 1 2 3\n", 2, {});
}

TEST_F(ObjTest, WorldCoordinatesMustBeFinite) {
  const dmat4 huge = glm::scale(dmat4(1), dvec3(1e39));
  const std::string message = input_error_of([&] { return read(square + "f 1 2 3\n", huge); });
  EXPECT_NE(message.find("not finite"), std::string::npos) << message;
  EXPECT_NE(message.find("mesh.obj"), std::string::npos) << message;
}

TEST_F(ObjTest, IndicesOutOfRangeNameTheLine) {
  expect_error(square + "f 1 2 3\nf 1 2 5\n", 6, {});
  expect_error(square + "f 1 2 -5\n", 5, {});
  expect_error(square + "f 1 2 3 5\n", 5, {});
  expect_error(square + "f 1 2 3 4 5\n", 5, {});
  expect_error(square + "f 1 2 99999999999\n", 5, {});
  expect_error(square + "f 1 2 4294967297\n", 5, {});
  expect_error(square + "f 1 2 -9223372036854775808\n", 5, {});
  expect_error(square + "f\t1 2 5\n", 5, {});
  expect_error("v 0 0 0\nf 1 2 3\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", 5, {});
}

TEST_F(ObjTest, OutOfRangeNormalsAndTextureCoordinatesNameTheLine) {
  expect_error(square + "vn 0 0 1\nf 1//2 2//2 3//2\n", 6, {});
  expect_error(square + "vn 0 0 1\nf 1//-2 2//-2 3//-2\n", 6, {});
  expect_error(square + "vt 0 0\nf 1/1 2/1 3/2\n", 6, {});
}

TEST_F(ObjTest, ZeroIndicesNameTheLine) {
  expect_error(square + "f 0 1 2\n", 5, {});
  expect_error(square + "vn 0 0 1\nf 1//0 2//1 3//1\n", 6, {});
}

TEST_F(ObjTest, MalformedFacesNameTheLine) {
  expect_error(square + "f a b c\n", 5, {});
  expect_error(square + "f 1 2\n", 5, {});
  expect_error(square + "f 1 2 3x\n", 5, {});
}

TEST_F(ObjTest, MissingFilesNameThePlaceInTheScene) {
  const SourceLocation where{"scene.xml", 7};
  for (const auto& path : {folder_.file("none.obj"), folder_.path()}) {
    const std::string message =
        input_error_of([&] { return read_obj(path, dmat4(1), where, diagnostics_); });
    expect_message(message, "scene.xml:7", {"cannot read", path.c_str()});
  }
}

}  // namespace

}  // namespace facet
