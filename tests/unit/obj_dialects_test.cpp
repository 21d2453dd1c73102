// What other programs read in OBJ files, and files that are none.
#include <gtest/gtest.h>

#include "support/obj.h"

namespace facet {

namespace {

using test::expect_message;
using test::square;

class ObjDialectsTest : public test::ObjTest {
 protected:
  /// A text that says the same as the square's lower right triangle.
  void expect_triangle(const std::string& text) {
    SCOPED_TRACE(text);
    const Mesh mesh = read(text);
    EXPECT_EQ(mesh.positions, (std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.position_indices, (std::vector<uvec3>{{0, 1, 2}}));
    EXPECT_TRUE(diagnostics_.warnings().empty());
  }
};

TEST_F(ObjDialectsTest, ABackslashContinuesALine) {
  expect_triangle(square + "f 1 \\\n2 3\n");
  expect_triangle(square + "f 1 2\\\n3\n");
  expect_triangle(square + "f 1 2\\\r\n  3\r\n");
  expect_triangle(square + "f\\\n1\\\n2\\\n3\n");
  expect_triangle(square + "f 1 2 3\\");
  expect_triangle(square + "f 1 2 3 \\\n");
  expect_triangle("v 0 \\\n0 0\nv 1 0\\\n 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\n");
  expect_triangle(square + "f 1 2 \\  \n3 # not here \\\n");
  // Lines are counted as they stand in the file.
  expect_error(square + "f 1 \\\n2 \\\n3\nf 1 2\n", 8, {"2 corners"});
  expect_error(square + "f 1 \\\n2 \\\nx\n", 5, {"\"x\""});
}

TEST_F(ObjDialectsTest, CommentsAndNamesMayEndInABackslash) {
  expect_triangle("# C:\\models\\\n" + square + "f 1 2 3\n");
  expect_triangle("mtllib C:\\models\\\nusemtl a\\\no b\\\ng c\\\n" + square + "f 1 2 3\n");
  expect_triangle(square + "f 1 2 3 # C:\\\n# the end\n");
}

TEST_F(ObjDialectsTest, LinesMayEndInCarriageReturns) {
  std::string text = square + "f 1 2 3\n";
  std::replace(text.begin(), text.end(), '\n', '\r');
  expect_triangle(text);
  text = square + "\nf 1 2\n";
  std::replace(text.begin(), text.end(), '\n', '\r');
  expect_error(text, 6, {"2 corners"});
  expect_triangle("# one\r\n# two\r# three\n" + square + "f 1 2 3\r");
  expect_error("# one\r\n# two\r# three\n" + square + "f 1 2\r\n", 8, {"2 corners"});
}

TEST_F(ObjDialectsTest, PaddingBehindTheTextIsNoPartOfIt) {
  const std::string ctrl_z("\x1A");
  const std::string zeros(3, '\0');
  expect_triangle(square + "f 1 2 3\n" + ctrl_z);
  expect_triangle(square + "f 1 2 3" + ctrl_z);
  expect_triangle(square + "f 1 2 3" + zeros);
  expect_triangle(square + "f 1 2 3\r\n" + ctrl_z + zeros);
  expect_triangle(square + "f 1 2 3\n" + ctrl_z + "\n");
}

TEST_F(ObjDialectsTest, CommentsMayBeGluedToWords) {
  expect_triangle("v 0 0 0#first\nv 1 0 0 #\nv 1 1 0\nv 0 1 0\nf 1 2 3# 4\n");
  expect_triangle("#v 5 5 5\n  # v 5 5 5\n" + square + "f 1 2 3#\n");
}

TEST_F(ObjDialectsTest, FacesMayHaveTheirOldName) { expect_triangle(square + "fo 1 2 3\n"); }

TEST_F(ObjDialectsTest, NumbersBelowTheSmallestAreZero) {
  expect_triangle("v 1e-400 -1e-99999999999 0.0e5\nv 1 1e-50 0\nv 1 1 0\nv .0 1. +0\nf 1 2 3\n");
}

TEST_F(ObjDialectsTest, SlashesMayFollowAnIndex) {
  expect_triangle(square + "f 1/ 2/ 3/\n");
  expect_triangle(square + "f 1// 2// 3//\n");
  const Mesh mesh = read(square + "vt 0 0\nvt 1 0\nf 1/1/ 2/2/ 3/2/\n");
  EXPECT_EQ(mesh.texcoord_indices, (std::vector<uvec3>{{0, 1, 1}}));
  EXPECT_TRUE(mesh.normal_indices.empty());
  expect_error(square + "f 1/// 2 3\n", 5, {"\"1///\""});
  expect_error(square + "f /1 2 3\n", 5, {"\"/1\""});
}

TEST_F(ObjDialectsTest, IndicesOfWhatTheFileHasNoneOfAreIgnoredWithOneWarning) {
  for (const char* faces : {"f 1//1 2//2 3//3\nf 1//1 3//3 4//4\n", "f 1//-1 2//-1 3//-1\n"}) {
    EXPECT_TRUE(read(square + faces).normal_indices.empty());
    expect_one_warning({"normals", "none"});
  }
  EXPECT_TRUE(read(square + "f 1/1 2/2 3/3\n").texcoord_indices.empty());
  expect_one_warning({"texture coordinates", "none"});
  // What stands behind the faces counts.
  EXPECT_EQ(read(square + "f 1//1 2//1 3//1\nvn 0 0 1\n").normal_indices.size(), 1U);
  EXPECT_TRUE(diagnostics_.warnings().empty());
  expect_error(square + "f 1//-1 2//-1 3//-1\nvn 0 0 1\n", 5, {"index -1", "normals"});
}

TEST_F(ObjDialectsTest, WhatIsNoNumberMattersWhereItIsUsed) {
  const std::string data = square + "vt nan 0\nvt 0 1\nvn 0 0 -nan(ind)\nvn 0 0 1\n";
  EXPECT_EQ(read(data + "f 1/2/2 2/2/2 3/2/2\n").normal_indices.size(), 1U);
  ASSERT_EQ(diagnostics_.warnings().size(), 2U);
  expect_message(diagnostics_.warnings()[0], "scene.xml:7", {"mesh.obj:5", "\"nan\"", "1 such"});
  expect_message(diagnostics_.warnings()[1], "scene.xml:7", {"mesh.obj:7", "\"-nan(ind)\""});
  expect_error(data + "f 1/2/2 2/1/2 3/2/2\n", 5, {"\"nan\" is not a finite number"});
  expect_error(data + "f 1/2/2 2/2/1 3/2/2\n", 7, {"\"-nan(ind)\" is not a finite number"});
  expect_error(square + "vn 0 1\nf 1//1 2//1 3//1\n", 5, {"2 coordinates"});
  // A large one is a number, but no float.
  expect_error(square + "vt 1e39 0\nf 1/1 2/1 3/1\n", 5, {"1e39"});
}

TEST_F(ObjDialectsTest, ColoursThatAreNoNumbersDrawOneWarning) {
  const Mesh mesh =
      read("v 0 0 0 red\nv 1 0 0 nan nan nan\nv 1 1 0 1 .5 .25\nvt 0 0 none\nf 1/1 2/1 3/1\n");
  EXPECT_EQ(mesh.position_indices.size(), 1U);
  expect_one_warning({"5 words", "not used"});
}

TEST_F(ObjDialectsTest, FilesOfOtherKindsAreNamed) {
  expect_refusal("", {"mesh.obj", "empty"});
  expect_refusal("\n \n", {"blanks"});
  expect_refusal("version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n",
                 {"Git LFS pointer", "git lfs pull"});
  expect_refusal("<!DOCTYPE html>\n<html><head><title>x</title></head></html>\n",
                 {"web page", "download"});
  expect_refusal("\n\n  <HTML lang=en>\n", {"web page"});
  expect_refusal("ply\nformat ascii 1.0\nelement vertex 8\n", {"PLY", "convert"});
  expect_refusal("solid cube\nfacet normal 0 0 1\n", {"STL"});
  expect_refusal(std::string("glTF\x02\0\0\0", 8), {"glTF"});
  expect_refusal("PK\x03\x04mesh.obj", {"ZIP"});
  expect_refusal("\x1F\x8B\x08", {"gzip"});
  expect_refusal(std::string("\xFF\xFEv\0 \0", 6), {"UTF-16", "UTF-8"});
  expect_refusal(std::string("v\0 \0001\0", 6), {"UTF-16"});
  expect_refusal(std::string("\0v\0 \0001", 6), {"UTF-16"});
  expect_refusal("# nothing else\n", {"Wavefront OBJ", "# nothing else"});
  expect_refusal("\x1B[31mHello\n", {"Wavefront OBJ", "\\x1b[31mHello"});
}

TEST_F(ObjDialectsTest, AHintTellsWhichFileWasMeant) {
  std::filesystem::create_directory(folder_.file("Meshes"));
  folder_.write("Meshes/Bunny.obj", square + "f 1 2 3\n");
  const auto message_for = [&](const std::string& name) {
    return test::input_error_of([&] {
      return read_obj(folder_.file(name), dmat4(1), {"scene.xml", 7}, diagnostics_);
    });
  };
  const std::string found = "there is \"" + folder_.file("Meshes/Bunny.obj").string() + "\"";
  expect_message(message_for("meshes/bunny.OBJ"), "scene.xml:7", {"no such file", found.c_str()});
  expect_message(message_for("Meshes\\Bunny.obj"), "scene.xml:7", {"no such file", found.c_str()});
  expect_message(message_for("C:\\Bunny.obj"), "scene.xml:7",
                 {"no such file", "separated by \"/\""});
  EXPECT_EQ(message_for("Meshes/Hare.obj").find("there is"), std::string::npos);
}

TEST_F(ObjDialectsTest, MaterialsMakeParts) {
  const ObjParts parts = read_parts("mtllib a b.mtl\nmtllib c.mtl \n" + square +
                                    "v 0 0 1\nvn 0 0 1\nvn 0 1 0\nf 1 2 3\n" +
                                    "usemtl  red one \nf 5//2 2//2 3//2\nusemtl blue\nf 1 3 "
                                    "4\nusemtl red one\nf 3 4 5\nusemtl unused\n");
  EXPECT_EQ(parts.material_files, (std::vector<std::string>{"a b.mtl", "c.mtl"}));
  EXPECT_EQ(parts.materials, (std::vector<std::string>{"", "red one", "blue"}));
  ASSERT_EQ(parts.meshes.size(), 3U);
  EXPECT_EQ(parts.meshes[0].positions.size(), 3U);
  EXPECT_TRUE(parts.meshes[0].normals.empty());
  EXPECT_EQ(parts.meshes[1].positions,
            (std::vector<vec3>{{0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(parts.meshes[1].position_indices, (std::vector<uvec3>{{0, 1, 2}, {2, 3, 0}}));
  EXPECT_EQ(parts.meshes[1].normals, (std::vector<vec3>{{0, 1, 0}}));
  ASSERT_EQ(parts.meshes[1].normal_indices.size(), 2U);
  EXPECT_EQ(parts.meshes[1].normal_indices[0], uvec3(0));
  EXPECT_EQ(parts.meshes[1].normal_indices[1].x, none);
  EXPECT_EQ(parts.meshes[2].position_indices.size(), 1U);
  EXPECT_EQ(read_parts(square + "usemtl a\nf 1 2 3\nf 1 3 4\n").meshes.size(), 1U);
}

}  // namespace

}  // namespace facet
