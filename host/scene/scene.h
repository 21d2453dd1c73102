#pragma once
// A scene as plain typed data, as the files say it: no defaults left to fill in, no packing for any
// renderer.
#include <facet/film.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/error.h"
#include "core/maths.h"
#include "scene/bsdf/bsdf.h"
#include "scene/camera.h"
#include "scene/integrator.h"
#include "scene/sampler.h"
#include "scene/texture/texture.h"

namespace facet {

class PropertyReader;

/// Triangles with what they look like. World space. Indices are zero-based; the three kinds of
/// vertex data have lists of their own, as in OBJ files.
struct Mesh {
  std::string name;  ///< the file it came from
  SourceLocation where;
  std::vector<vec3> positions;
  std::vector<vec3> normals;  ///< unit; empty without
  std::vector<vec2> texcoords;
  std::vector<uvec3> position_indices;
  std::vector<uvec3>
      normal_indices;  ///< one a triangle or empty; x = none: that triangle has no normals
  std::vector<uvec3> texcoord_indices;  ///< likewise
  std::uint32_t bsdf = 0;               ///< index into Scene::bsdfs
  std::uint32_t emitter = none;         ///< index into Scene::emitters
};

/// Corners of a triangle of the mesh.
[[nodiscard]] std::array<vec3, 3> triangle_corners(const Mesh& mesh, std::size_t triangle);

/// Area of a triangle of the mesh in m^2; 0 if it is too small for a float to hold, so that nothing
/// can hit it.
[[nodiscard]] double triangle_area(const Mesh& mesh, std::size_t triangle);

/// One-sided emission of a mesh.
struct AreaEmitter {
  std::uint32_t mesh = 0;  ///< index into Scene::meshes
  Textured<Color> radiance{Color(1)};
  double scale = 1;

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    visit("scale", p.scale, parameter::Scale{}, "factor on the radiance");
    visit("radiance", p.radiance, parameter::NonNegativeColor{.scale = p.scale},
          "emitted radiance, W sr^-1 m^-2");
  }
  /// Throws InputError where the scale makes the radiance too large.
  void check(const PropertyReader& properties) const;
  /// Radiance with the scale; a factor on the texture where there is one.
  [[nodiscard]] Textured<Color> emitted() const {
    return parameter::NonNegativeColor{.scale = scale}.scaled(radiance);
  }
};

/// Light from a point, equal in all directions.
struct PointLight {
  vec3 position{0, 100, 0};
  Color intensity{1};  ///< W sr^-1

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    visit("position", p.position, parameter::Point{}, "in the scene's space");
    visit("radiance", p.intensity, parameter::NonNegativeColor{},
          "radiant intensity, W sr^-1; falls off with 1/d^2");
  }
};

/// Light from infinity: latitude-longitude map, already scaled; 1x1 where constant. Rows as in the
/// file: up is the last.
struct EnvironmentEmitter {
  int width = 1;
  int height = 1;
  std::vector<Color> texels;

  /// The kernels' record of it has no parameters: the texels hold them all.
  template <typename Self, typename Visitor>
  static void declare(Self& /*p*/, Visitor& /*visit*/) {}
};

/// Any emitter; the alternative's index is the id of the shared list.
using Emitter = std::variant<AreaEmitter, EnvironmentEmitter, PointLight>;

struct Scene {
  std::filesystem::path file;
  std::vector<Mesh> meshes;
  std::vector<Bsdf> bsdfs;
  std::vector<Emitter> emitters;
  std::vector<Texture> textures;
  Camera camera;
  Integrator integrator;
  int sample_count = 1;
  std::uint32_t seed = 0;
  Sampler sampler = Sampler::independent;

  [[nodiscard]] std::size_t triangle_count() const;
  [[nodiscard]] Box bounds() const;
  /// Index of the environment among the emitters, none without one.
  [[nodiscard]] std::uint32_t environment() const;
  /// Radiance of an area emitter for its share of emitter samples: with the mean of its texture.
  [[nodiscard]] Color mean_radiance(const AreaEmitter& emitter) const;
};

}  // namespace facet
