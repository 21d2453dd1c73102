#include "scene/mesh/mtl.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string_view>

#include "core/input_file.h"
#include "core/memory.h"
#include "core/text.h"

namespace facet {

namespace {

/// A file that another one names, whatever separates its folders.
std::filesystem::path beside(const std::filesystem::path& folder, std::string_view name) {
  const std::filesystem::path path = folder / trimmed(name);
  std::error_code unknown;
  if (std::filesystem::exists(path, unknown)) return path;
  std::string slashed(trimmed(name));
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  return folder / slashed;
}

class MtlReader {
 public:
  MtlReader(std::filesystem::path path, const SourceLocation& where, Diagnostics& diagnostics)
      : path_(std::move(path)), where_(where), diagnostics_(diagnostics) {}

  void read(std::map<std::string, MtlMaterial>& result) {
    const Activity activity("reading the materials " + path_.string());
    std::string text = read_input_file(path_);
    if (const auto foreign = recognise_foreign_file(text, "a materials file"))
      throw InputError(fmt::format("{}: {}", path_.string(), *foreign));
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    std::istringstream in(text);
    std::map<std::string, int> indices;
    std::vector<tinyobj::material_t> materials;
    std::string ignored_warnings;
    std::string ignored_errors;
    tinyobj::LoadMtl(&indices, &materials, &in, &ignored_warnings, &ignored_errors);
    for (const tinyobj::material_t& m : materials) {
      const std::string name(trimmed(m.name));
      if (!name.empty()) result.try_emplace(name, convert(m));
    }
  }

 private:
  MtlMaterial convert(const tinyobj::material_t& m) {
    MtlMaterial material;
    for (int i = 0; i < 3; ++i) {
      const double kd = m.diffuse[i];
      material.diffuse[i] = std::isfinite(kd) ? static_cast<float>(std::clamp(kd, 0.0, 1.0)) : 0.5F;
      if (!(kd >= 0 && kd <= 1))
        warn_once(m.name, fmt::format("Kd holds {:g}, which is moved into 0 to 1", kd));
    }
    if (trimmed(m.diffuse_texname).empty()) return material;
    material.diffuse_map = beside(path_.parent_path(), m.diffuse_texname);
    const tinyobj::texture_option_t& o = m.diffuse_texopt;
    const bool is_plain =
        std::all_of(o.origin_offset, o.origin_offset + 3, [](double x) { return x == 0; }) &&
        std::all_of(o.scale, o.scale + 3, [](double x) { return x == 1; }) && !o.clamp;
    if (!is_plain) warn_once(m.name, "the options -o, -s and -clamp of map_Kd are ignored");
    return material;
  }

  void warn_once(const std::string& material, const std::string& message) {
    if (warned_.insert(message).second)
      diagnostics_.warn(where_, fmt::format("{}: material \"{}\": {}", path_.string(),
                                            trimmed(material), message));
  }

  std::filesystem::path path_;
  const SourceLocation& where_;
  Diagnostics& diagnostics_;
  std::set<std::string> warned_;
};

}  // namespace

std::map<std::string, MtlMaterial> read_mtl(const std::vector<std::string>& files,
                                            const std::filesystem::path& folder,
                                            const SourceLocation& where, Diagnostics& diagnostics) {
  std::map<std::string, MtlMaterial> materials;
  for (const std::string& file : files) {
    const std::filesystem::path path = beside(folder, file);
    diagnostics.add_input(where, path);
    try {
      MtlReader(path, where, diagnostics).read(materials);
    } catch (const InputError& e) {
      diagnostics.warn(where, fmt::format("materials are missing: {}", e.what()));
    }
  }
  for (const auto& [name, material] : materials) {
    if (!material.diffuse_map.empty()) diagnostics.add_input(where, material.diffuse_map);
  }
  return materials;
}

}  // namespace facet
