#version 450
// Evaluates one of our functions of numbers for every input; for tests/unit/elementary_test.cpp.
#extension GL_GOOGLE_include_directive : require
#include "../../shaders/lib/fresnel.glsl"
#include "../../shaders/lib/beckmann.glsl"
#include "../../shaders/lib/choice.glsl"
#include "../../shaders/shared/random_hash.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint FUNCTION = 0;
layout(std430, binding = 0) readonly buffer Inputs { vec2 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec2 outputs[]; };

/// The two halves of a quotient of hashed words; kind 1: of the largest dividend.
vec2 hashed_quotient(uint i, uint kind) {
  uvec4 words = pcg4d(uvec4(i, 0u, 0u, 0u));
  uint divisor = max(words.x >> (words.w & 31u), 1u);
  uint high = kind == 1u ? divisor - 1u : words.y % divisor;
  uint quotient = divide_wide(high, kind == 1u ? 0xffffffffu : words.z, divisor);
  return vec2(float(quotient >> 16u), float(quotient & 0xffffu));
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(inputs.length())) return;
  vec2 x = inputs[i];
  vec2 y = vec2(0.0);
  if (FUNCTION == 0u) y.x = exp_accurate(x.x);
  if (FUNCTION == 1u) y.x = log_accurate(x.x);
  if (FUNCTION == 2u) y = sincos_turns(x.x);
  if (FUNCTION == 3u) y.x = atan2_accurate(x.x, x.y);
  if (FUNCTION == 4u) y.x = erfc_accurate(x.x);
  if (FUNCTION == 5u) y.x = erfinv_quantile(x.x);
  if (FUNCTION == 6u) y.x = beckmann_visible_slope(sqrt((1.0 - x.x) * (1.0 + x.x)), x.x, x.y);
  if (FUNCTION == 7u) y.x = fresnel_dielectric(x.x, 1.0, x.y);
  if (FUNCTION == 8u) y = hashed_quotient(uint(x.x), uint(x.y));
  outputs[i] = y;
}
