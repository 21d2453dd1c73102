#pragma once
// Parameters that a texture may give.
#include "core/maths.h"

namespace facet {

/// A value that is the same everywhere, or that of a texture (of a number: the texture's
/// luminance).
template <typename Value>
struct Textured {
  Value value{};                 ///< of no meaning where there is a texture
  std::uint32_t texture = none;  ///< index into Scene::textures

  Textured() = default;
  Textured(const Value& constant)
      : value(constant) {}  // NOLINT(google-explicit-constructor): a constant is one
  [[nodiscard]] bool is_textured() const { return texture != none; }
};

}  // namespace facet
