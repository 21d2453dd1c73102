// Lets one header be read by GLSL and by C++: GLSL's vector names, mapped to GLM on the host.
// Records built from these types are multiples of 16 bytes and hold neither vec3 nor bool, so that
// std430 and C++ lay them out alike.
#ifndef FACET_SHARED_TYPES_H
#define FACET_SHARED_TYPES_H

#ifdef __cplusplus
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace facet::shared {
using uint = glm::uint;
using glm::uvec2;
using glm::uvec4;
using glm::vec2;
using glm::vec4;
}  // namespace facet::shared

#define FACET_SHARED_BEGIN namespace facet::shared {
#define FACET_SHARED_END }
#define FACET_CONSTANT constexpr
#define FACET_FUNCTION inline
#else
#define FACET_SHARED_BEGIN
#define FACET_SHARED_END
#define FACET_CONSTANT const
#define FACET_FUNCTION
#endif

#endif
