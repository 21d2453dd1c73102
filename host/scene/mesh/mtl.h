#pragma once
// Materials files of Wavefront OBJ.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "core/maths.h"

namespace facet {

/// What facet takes of a material: how it reflects diffusely.
struct MtlMaterial {
  Color diffuse{0.5F};                ///< Kd, in [0, 1]
  std::filesystem::path diffuse_map;  ///< map_Kd, in place of Kd; empty without
};

/// Reads the materials of files by their names; of two of one name the first counts. files: as an
/// OBJ file in `folder` names them. Warns at `where` of a file that cannot be read, of values that
/// are not used as they stand, and notes the files as inputs.
[[nodiscard]] std::map<std::string, MtlMaterial> read_mtl(const std::vector<std::string>& files,
                                                          const std::filesystem::path& folder,
                                                          const SourceLocation& where,
                                                          Diagnostics& diagnostics);

}  // namespace facet
