// Products of vectors in a fixed order of operations, and components by number. GLSL's dot, cross
// and mix leave the order to the driver, and drivers differ.
#ifndef FACET_VECTOR_GLSL
#define FACET_VECTOR_GLSL

float dot3(vec3 a, vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

vec3 cross3(vec3 a, vec3 b) {
  return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/// a at t = 0, b at t = 1.
float lerp(float a, float b, float t) { return (1.0 - t) * a + t * b; }

/// Word i, 0 to 3, without an array of memory.
uint word_of(uvec4 t, uint i) {
  uint low = i == 0u ? t.x : t.y;
  uint high = i == 2u ? t.z : t.w;
  return i < 2u ? low : high;
}

float component(vec4 v, uint i) { return uintBitsToFloat(word_of(floatBitsToUint(v), i)); }

#endif
