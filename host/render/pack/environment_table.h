#pragma once
// The sampling density of an environment (docs/reference/sampling.md, "Environment").
#include <vector>

#include "scene/scene.h"
#include "shared/records.h"

namespace facet {

struct EnvironmentTable {
  std::vector<glm::vec4> texels;  ///< rgb, and the density of the texel's cell in sr^-1
  std::vector<shared::EnvironmentRow> rows;
  std::vector<std::uint32_t> columns;  ///< cumulative counts, a row of the image after another
  double mean_luminance = 0;           ///< over the sphere
};

/// compensated: for samples that share the work with those of BSDFs.
[[nodiscard]] EnvironmentTable make_environment_table(const EnvironmentEmitter& environment,
                                                      bool compensated);

}  // namespace facet
