#pragma once
// Scenes: from a file, or made in memory.
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace facet {

/// What the files of a scene say. Nothing that renders it changes it.
struct Scene;
using ScenePtr = std::shared_ptr<const Scene>;

struct LoadOptions {
  bool strict = false;  ///< whether a warning is an error
  /// Where not empty: the folder below which every file that is read must lie, after links.
  std::filesystem::path assets_below = {};
  std::function<void(const std::string& message)> on_warning = {};
};

/// Reads a scene in Nori's language. Throws Error with file and line for whatever is wrong.
[[nodiscard]] ScenePtr load_scene(const std::filesystem::path& path,
                                  const LoadOptions& options = {});

/// What a scene holds.
struct SceneSummary {
  std::string file;
  int width = 0;  ///< of the image, pixels
  int height = 0;
  int samples = 0;         ///< of each pixel
  std::string integrator;  ///< empty where the scene names none
  std::string sampler;
  std::size_t triangles = 0;
  std::size_t emitters = 0;
};
[[nodiscard]] SceneSummary summarise(const Scene& scene);

using Vector3 = std::array<float, 3>;

/// Rows of a 4x4 matrix that maps columns (x, y, z, 1).
using Matrix4 = std::array<std::array<double, 4>, 4>;

/// A camera's toWorld: at `origin`, looking at `target`, with `up` towards the image's top.
struct LookAt {
  Vector3 origin{};
  Vector3 target{};
  Vector3 up{0, 1, 0};
};

/// A linear colour or radiance, Rec. 709 primaries.
struct Rgb {
  float r = 0;
  float g = 0;
  float b = 0;
};

struct Plugin;

/// The value of a plugin's parameter: of the type that the plugin's manual states (`facet info
/// --plugins NAME`).
using ParameterValue = std::variant<bool, int, double, const char*, std::string, Rgb, Vector3,
                                    Matrix4, LookAt, std::vector<Plugin>>;

struct Parameter {
  std::string name;
  ParameterValue value;
};

/// An object of the scene language: its type, and its parameters by name. A nested object is a
/// vector of one plugin: a texture under the name of the parameter that it stands for, or a
/// camera's "rfilter".
///
///     facet::Plugin{"roughconductor", {{"alpha", 0.1}, {"material", "Cu"}}}
struct Plugin {
  std::string type;
  std::vector<Parameter> parameters = {};
};

/// Triangles in world space, counter-clockwise seen from the front.
struct TriangleMesh {
  std::vector<Vector3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of positions
  std::vector<Vector3> normals = {};                    ///< one a position, unit; or none
  std::vector<std::array<float, 2>> texcoords = {};     ///< one a position; or none
};

/// Collects a scene in memory.
class SceneMaker {
 public:
  SceneMaker();
  ~SceneMaker();
  SceneMaker(SceneMaker&&) noexcept;
  SceneMaker& operator=(SceneMaker&&) noexcept;

  /// Of type "perspective"; a parameter "rfilter" that holds a plugin is the reconstruction filter.
  SceneMaker& camera(const Plugin& plugin);
  SceneMaker& sampler(const Plugin& plugin);
  SceneMaker& integrator(const Plugin& plugin);
  /// A light that is no mesh: an environment or a point light.
  SceneMaker& emitter(const Plugin& plugin);
  SceneMaker& mesh(const TriangleMesh& mesh, const Plugin& bsdf);
  /// A mesh that emits: of type "area".
  SceneMaker& mesh(const TriangleMesh& mesh, const Plugin& bsdf, const Plugin& emitter);

  /// The scene so far. Throws Error for whatever the scene language does not allow, naming the
  /// plugin.
  [[nodiscard]] ScenePtr scene(const LoadOptions& options = {}) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace facet
