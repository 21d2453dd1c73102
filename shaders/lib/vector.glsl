// Products of vectors in a fixed order of operations. GLSL's dot, cross and mix leave the order to the driver, and drivers differ.
#ifndef FACET_VECTOR_GLSL
#define FACET_VECTOR_GLSL

float dot3(vec3 a, vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

vec3 cross3(vec3 a, vec3 b) { return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); }

/// a at t = 0, b at t = 1.
float lerp(float a, float b, float t) { return (1.0 - t) * a + t * b; }

#endif
