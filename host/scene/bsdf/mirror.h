#pragma once
#include <cstdint>

#include "shared/records.h"

namespace facet::bsdf {

/// A perfect mirror; manual in shaders/bsdf/mirror.glsl.
struct Mirror {
  template <typename Self, typename Visitor>
  static void declare(Self& /*p*/, Visitor& /*visit*/) {}
  [[nodiscard]] static std::uint32_t flags() { return shared::BSDF_DELTA; }
};

}  // namespace facet::bsdf
