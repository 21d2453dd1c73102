// The GGX microfacet distribution (B. Walter et al. 2007; T. Trowbridge, K. Reitz 1975): density,
// masking, and two ways of sampling half vectors. Directions are in the shading frame, wo and wi on
// the upper side.
#ifndef FACET_GGX_GLSL
#define FACET_GGX_GLSL
#include "elementary.glsl"
#include "frame.glsl"

/// Density D(wh) in sr^-1, for a half vector h of any length.
float ggx_d(vec3 h, float alpha) {
  float r2 = h.x * h.x + h.y * h.y;
  float z2 = h.z * h.z;
  float a2 = alpha * alpha;
  // alpha^2 (r^2 + z^2)^2 / (pi (alpha^2 z^2 + r^2)^2), as the square of a ratio that neither over-
  // nor underflows.
  float ratio = (r2 + z2) / (a2 * z2 + r2);
  return h.z > 0.0 ? (a2 * INV_PI) * (ratio * ratio) : 0.0;
}

/// Smith's masking G1 of direction w, which also normalises the visible normals.
float ggx_g1(vec3 w, float alpha) {
  float sin2 = w.x * w.x + w.y * w.y;
  float root = sqrt(w.z * w.z + (alpha * alpha) * sin2);
  return w.z > 0.0 ? 2.0 * w.z / (w.z + root) : 0.0;
}

/// Unit half vector with density D(wh) cos(theta_h).
vec3 ggx_sample_ndf(float alpha, vec2 u) {
  float tangent = alpha * sqrt(u.x / (1.0 - u.x));
  float c = 1.0 / sqrt(1.0 + tangent * tangent);
  float s = tangent * c;
  vec2 sc = sincos_turns(u.y);
  return vec3(s * sc.y, s * sc.x, c);
}

/// Unit half vector with density G1(wo) D(wh) max(0, wo.wh) / cos(theta_o).
/// J. Dupuy, A. Benyoub, "Sampling Visible GGX Normals with Spherical Caps", CGF 42(8), 2023.
vec3 ggx_sample_visible(vec3 wo, float alpha, vec2 u) {
  vec3 w = normalize_safe(vec3(alpha * wo.x, alpha * wo.y, wo.z));
  float t = u.x * (1.0 + w.z);
  float r = sqrt(max(t * (2.0 - t), 0.0));
  vec2 sc = sincos_turns(u.y);
  vec3 h = vec3(r * sc.y + w.x, r * sc.x + w.y, (1.0 - u.x) * (1.0 + w.z));
  return normalize_safe(vec3(alpha * h.x, alpha * h.y, h.z));
}

#endif
