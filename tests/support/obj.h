#pragma once
// Meshes from texts.
#include <initializer_list>
#include <string>

#include "scene/mesh/obj.h"
#include "support/input.h"

namespace facet::test {

/// Four corners of the unit square, counterclockwise.
inline const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// In m^2.
inline double area(const Mesh& mesh) {
  double sum = 0;
  for (const uvec3& t : mesh.position_indices) {
    const vec3 a = mesh.positions[t.x];
    sum += 0.5 * static_cast<double>(
                     glm::length(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a)));
  }
  return sum;
}

/// A folder for mesh.obj, which line 7 of scene.xml names.
class ObjTest : public ::testing::Test {
 protected:
  Mesh read(const std::string& text, const dmat4& to_world = dmat4(1)) {
    diagnostics_ = Diagnostics();
    return read_obj(folder_.write("mesh.obj", text), to_world, {"scene.xml", 7}, diagnostics_);
  }
  ObjParts read_parts(const std::string& text) {
    diagnostics_ = Diagnostics();
    return read_obj_by_material(folder_.write("mesh.obj", text), dmat4(1), {"scene.xml", 7},
                                diagnostics_);
  }
  void expect_error(const std::string& text, int line, std::initializer_list<const char*> words) {
    SCOPED_TRACE(text.substr(0, 1000));
    expect_message(input_error_of([&] { return read(text); }),
                   place(folder_.file("mesh.obj"), line), words);
  }
  /// Of a file as a whole.
  void expect_refusal(const std::string& text, std::initializer_list<const char*> words) {
    SCOPED_TRACE(text.substr(0, 1000));
    expect_message(input_error_of([&] { return read(text); }), "scene.xml:7", words);
  }
  /// Of the last file that was read.
  void expect_one_warning(std::initializer_list<const char*> words) {
    ASSERT_EQ(diagnostics_.warnings().size(), 1U);
    expect_message(diagnostics_.warnings()[0], "scene.xml:7", words);
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

}  // namespace facet::test
