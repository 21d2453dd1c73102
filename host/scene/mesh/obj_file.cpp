#include "scene/mesh/obj_file.h"

#include <tiny_obj_loader.h>

#include <array>
#include <cmath>
#include <istream>
#include <map>
#include <utility>

#include "core/input_file.h"
#include "core/memory.h"
#include "scene/mesh/obj_lines.h"

namespace facet {

namespace {

constexpr std::string_view wanted = "a Wavefront OBJ mesh";

/// Where the indices of one kind that are larger than any before are, which may still be in range:
/// what they count can stand behind them in the file.
class LargestIndices {
 public:
  /// written: as it stands in the file.
  void add(std::uint32_t index, int written, int line) {
    if (places_.empty() || index > places_.back().index) places_.push_back({index, written, line});
  }
  /// Throws for the first one that is not below count.
  void check(std::size_t count, std::string_view what, const std::filesystem::path& path) const {
    for (const Place& place : places_) {
      if (place.index < count) continue;
      throw InputError(
          {path.string(), place.line},
          fmt::format("index {} is out of range: there are {} {}", place.written, count, what));
    }
  }

 private:
  struct Place {
    std::uint32_t index;
    int written;
    int line;
  };
  std::vector<Place> places_;
};

/// Statements that are wrong where a face uses them, by their index.
struct Flaw {
  int line = 0;
  std::string message;
};
using Flaws = std::map<std::uint32_t, Flaw>;

/// Takes tinyobjloader's statements; checks what it does not.
class Loader {
 public:
  explicit Loader(const std::filesystem::path& path, std::string text)
      : path_(path), lines_(path, std::move(text)) {}

  [[nodiscard]] ObjFile load(const SourceLocation& where, Diagnostics& diagnostics) && {
    tinyobj::callback_t callback;
    callback.vertex_cb = [](void* loader, double x, double y, double z, double /*w*/) {
      to(loader).add_position(dvec3(x, y, z));
    };
    callback.texcoord_cb = [](void* loader, double u, double v, double /*w*/) {
      to(loader).add_texcoord(vec2(u, v));
    };
    callback.normal_cb = [](void* loader, double x, double y, double z) {
      to(loader).add_normal(vec3(x, y, z));
    };
    callback.index_cb = [](void* loader, tinyobj::index_t* corners, int count) {
      to(loader).add_face(std::span(corners, static_cast<std::size_t>(count)));
    };
    callback.usemtl_cb = [](void* loader, const char* name, int /*id*/) {
      to(loader).use_material(name);
    };
    std::istream in(&lines_);
    // What the lines throw passes through the stream.
    in.exceptions(std::ios::badbit);
    tinyobj::LoadObjWithCallback(in, callback, this);
    check_indices(where, diagnostics);
    file_.material_files = lines_.material_files();
    return std::move(file_);
  }

 private:
  static Loader& to(void* loader) { return *static_cast<Loader*>(loader); }

  void add_position(const dvec3& p) {
    const vec3 position(p);
    if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z))
      lines_.fail("a coordinate is not a finite number");
    file_.positions.push_back(position);
  }
  void add_texcoord(const vec2& t) {
    note_flaw(texcoord_flaws_, file_.texcoords.size(), std::isfinite(t.x) && std::isfinite(t.y));
    file_.texcoords.push_back(t);
  }
  void add_normal(const vec3& n) {
    note_flaw(normal_flaws_, file_.normals.size(),
              std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z));
    file_.normals.push_back(n);
  }
  void note_flaw(Flaws& flaws, std::size_t index, bool is_finite) const {
    if (lines_.flaw().empty() && is_finite) return;
    flaws[static_cast<std::uint32_t>(index)] = {
        lines_.line(),
        lines_.flaw().empty() ? "a coordinate is not a finite number" : lines_.flaw()};
  }

  void add_face(std::span<const tinyobj::index_t> corners) {
    for (const tinyobj::index_t& c : corners) {
      ObjCorner corner;
      corner.position =
          resolve(c.vertex_index, file_.positions.size(), "vertices", largest_position_);
      corner.texcoord = resolve(c.texcoord_index, file_.texcoords.size(), "texture coordinates",
                                largest_texcoord_);
      corner.normal = resolve(c.normal_index, file_.normals.size(), "normals", largest_normal_);
      file_.corners.push_back(corner);
    }
    file_.faces.push_back({static_cast<std::uint32_t>(corners.size()), material_});
  }
  /// Of the file's index: 0 where there is none, from 1, or negative and counted from the last
  /// before it.
  std::uint32_t resolve(int index, std::size_t count, std::string_view what,
                        LargestIndices& largest) const {
    if (index == 0) return none;
    if (index > 0) {
      const auto i = static_cast<std::uint32_t>(index - 1);
      if (i >= count) largest.add(i, index, lines_.line());
      return i;
    }
    const long long i = static_cast<long long>(count) + index;
    if (i >= 0) return static_cast<std::uint32_t>(i);
    // Files that have no texture coordinates or normals at all may speak of them.
    if (count == 0 && what != "vertices") {
      largest.add(none - 1, index, lines_.line());
      return none - 1;
    }
    lines_.fail(fmt::format("index {} is out of range: there are {} {}", index, count, what));
  }

  void use_material(const std::string& name) {
    const auto [at, is_new] =
        materials_.try_emplace(name, static_cast<std::uint32_t>(file_.materials.size()));
    if (is_new) file_.materials.push_back(name);
    material_ = at->second;
  }

  void check_indices(const SourceLocation& where, Diagnostics& diagnostics) {
    largest_position_.check(file_.positions.size(), "vertices", path_);
    check_optional(&ObjCorner::texcoord, file_.texcoords.size(), "texture coordinates",
                   largest_texcoord_, texcoord_flaws_, where, diagnostics);
    check_optional(&ObjCorner::normal, file_.normals.size(), "normals", largest_normal_,
                   normal_flaws_, where, diagnostics);
    if (lines_.unused_bad_words() > 0)
      diagnostics.warn(where,
                       fmt::format("{}: {} words where numbers are expected, in what is not used",
                                   path_.string(), lines_.unused_bad_words()));
  }

  /// Of the corners' texture coordinates or normals.
  void check_optional(std::uint32_t ObjCorner::*index, std::size_t count, std::string_view what,
                      const LargestIndices& largest, const Flaws& flaws,
                      const SourceLocation& where, Diagnostics& diagnostics) {
    if (count == 0) {
      bool is_spoken_of = false;
      for (ObjCorner& corner : file_.corners)
        is_spoken_of |= std::exchange(corner.*index, none) != none;
      if (is_spoken_of)
        diagnostics.warn(
            where,
            fmt::format(
                "{}: its faces have indices of {}, of which there are none; they are ignored",
                path_.string(), what));
      return;
    }
    largest.check(count, what, path_);
    if (flaws.empty()) return;
    for (const ObjCorner& corner : file_.corners) {
      const auto flaw = flaws.find(corner.*index);
      if (flaw != flaws.end())
        throw InputError({path_.string(), flaw->second.line}, flaw->second.message);
    }
    diagnostics.warn(
        where,
        fmt::format("{}:{}: {}; {} such lines are ignored, since no face uses them", path_.string(),
                    flaws.begin()->second.line, flaws.begin()->second.message, flaws.size()));
  }

  const std::filesystem::path& path_;
  ObjLines lines_;
  ObjFile file_;
  std::map<std::string, std::uint32_t> materials_;
  std::uint32_t material_ = none;
  LargestIndices largest_position_;
  LargestIndices largest_texcoord_;
  LargestIndices largest_normal_;
  Flaws texcoord_flaws_;
  Flaws normal_flaws_;
};

}  // namespace

ObjFile read_obj_file(const std::filesystem::path& path, const SourceLocation& where,
                      Diagnostics& diagnostics) {
  const Activity activity("reading the mesh " + path.string());
  const auto refuse = [&](const std::string& message) {
    throw InputError(where, fmt::format("cannot read the mesh {}", message));
  };
  std::string text;
  try {
    text = read_input_file(path);
  } catch (const InputError& e) {
    refuse(e.what());
  }
  const std::string start = text.substr(0, 1000);
  if (const auto foreign = recognise_foreign_file(start, wanted))
    refuse(fmt::format("{}: {}", path.string(), *foreign));
  ObjFile file = Loader(path, std::move(text)).load(where, diagnostics);
  if (file.positions.empty() && file.faces.empty())
    refuse(fmt::format("{}: {}", path.string(), describe_foreign_file(start, wanted)));
  return file;
}

}  // namespace facet
