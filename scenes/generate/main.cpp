/// facet_generate_scenes SCENES_DIR
///
/// Makes the meshes and the sky that the scenes refer to, deterministically. What is there already
/// is not made again, and a `serapis.obj` that somebody else put into scenes/serapis is never
/// touched.

#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "asset_file.h"
#include "bust.h"
#include "mesh.h"
#include "sky.h"

namespace facet::generate {
namespace {

namespace fs = std::filesystem;

/// Change these when the generated files change; old files are then made anew.
const std::string assets_version = "facet scene assets v1";
const std::string bust_marker = "facet stand-in bust v1";
const std::string bust_marker_start = "# facet stand-in bust v";

/// True when `folder` holds all of `names` from this version of the program.
bool up_to_date(const fs::path& folder, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (!fs::exists(folder / name)) return false;
  }
  return first_line(folder / ".version") == assets_version;
}

void stamp(const fs::path& folder) { replace_file(folder / ".version", assets_version + "\n"); }

void generate_sphere(const fs::path& scene) {
  const fs::path folder = scene / "generated";
  if (up_to_date(folder, {"sphere.obj"})) return;
  write_obj(make_sphere(96, 48), folder / "sphere.obj", "facet unit sphere");
  stamp(folder);
}

void generate_sky(const fs::path& scene) {
  const fs::path folder = scene / "generated";
  if (up_to_date(folder, {"sky.exr"})) return;
  write_sky(folder / "sky.exr");
  stamp(folder);
}

void generate_bust(const fs::path& file) {
  const std::string line = first_line(file);
  const bool exists = fs::exists(file);
  const bool ours = line.starts_with(bust_marker_start);
  if (exists && (!ours || line == "# " + bust_marker)) return;
  write_obj(make_bust(), file, bust_marker);
}

void generate_all(const fs::path& scenes) {
  generate_sphere(scenes / "cbox");
  generate_sphere(scenes / "materials");
  generate_sphere(scenes / "veach_mi");
  generate_sphere(scenes / "whitted");
  generate_sky(scenes / "serapis");
  generate_bust(scenes / "serapis" / "serapis.obj");
}

}  // namespace
}  // namespace facet::generate

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: facet_generate_scenes SCENES_DIR\n";
    return 2;
  }
  try {
    facet::generate::generate_all(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "facet_generate_scenes: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
