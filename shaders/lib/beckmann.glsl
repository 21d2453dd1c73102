// The Beckmann microfacet distribution: density, masking, and two ways of sampling half vectors.
// Directions are in the shading frame, wo and wi on the upper side.
#ifndef FACET_BECKMANN_GLSL
#define FACET_BECKMANN_GLSL
#include "elementary.glsl"
#include "frame.glsl"

/// Beckmann density D(wh) in sr^-1, for a half vector h of any length: without normalising, tan^2
/// keeps its digits where wi and wo nearly cancel. alpha in [1e-4, 1].
float beckmann_d(vec3 h, float alpha) {
  float z2 = h.z * h.z;
  float r2 = h.x * h.x + h.y * h.y;
  float x = r2 / (z2 * alpha * alpha);
  float cos2 = z2 / (r2 + z2);
  float d = exp_accurate(-x) * INV_PI / (alpha * alpha) / cos2 / cos2;
  return (h.z > 0.0 && x < 87.0) ? d : 0.0;
}

/// Masking G1 of direction w, rational form: B. Walter et al., "Microfacet Models for Refraction
/// through Rough Surfaces", EGSR 2007, eq. 27.
float beckmann_g1_rational(vec3 w, float alpha) {
  float sin2 = w.x * w.x + w.y * w.y;
  float b = w.z / (alpha * sqrt(max(sin2, 1.0e-30)));
  float c = min(b, 1.6);
  float g = c * (3.535 + 2.181 * c) / (1.0 + c * (2.276 + 2.577 * c));
  g = b >= 1.6 ? 1.0 : g;
  return w.z > 0.0 ? g : 0.0;
}

/// Exact Smith G1 of the Beckmann distribution, which normalises the visible normals: 1/(1 +
/// Lambda), written as a sum of positive terms.
float beckmann_g1_exact(vec3 w, float alpha) {
  float sin2 = w.x * w.x + w.y * w.y;
  float b = min(w.z / (alpha * sqrt(max(sin2, 1.0e-30))), 1.0e6);
  float one_plus_lambda =
      0.5 * erfc_accurate(-b) + exp_accurate(-b * b) * 0.5 * INV_SQRT_PI / max(b, 1.0e-30);
  return w.z > 0.0 ? 1.0 / one_plus_lambda : 0.0;
}

/// Unit half vector with density D(wh) cos(theta_h).
vec3 beckmann_sample_ndf(float alpha, vec2 u) {
  float tan2 = -alpha * alpha * log_accurate(1.0 - u.x);
  float c = 1.0 / sqrt(1.0 + tan2);
  float s = sqrt(tan2) * c;
  vec2 sc = sincos_turns(u.y);
  return vec3(s * sc.y, s * sc.x, c);
}

/// Slope along the direction of view whose visible cumulative distribution is u (alpha = 1): the
/// root x of c erfc(-x) + s/sqrt(pi) exp(-x^2) = u (the same at x = c/s), where (s, c) are sine and
/// cosine of the polar angle. Halley's iteration within a bracket; docs/reference/sampling.md
/// derives it from Heitz and d'Eon 2014.
float beckmann_visible_slope(float s, float c, float u) {
  float upper = min(c / max(s, 1.0e-20), 6.0);
  float lower = -6.0;
  float target = u * (c * erfc_accurate(-upper) + s * INV_SQRT_PI * exp_accurate(-upper * upper));
  float x = min(lerp(erfinv_quantile(u), -sqrt(-log_accurate(u)), s), upper);
  bool done = false;
  for (uint k = 0u; k < 12u; ++k) {
    float gauss = exp_accurate(-x * x);
    float visible = max(c - s * x, 1.0e-30);
    float residual = c * erfc_accurate(-x) + s * INV_SQRT_PI * gauss - target;
    lower = residual < 0.0 ? x : lower;
    upper = residual < 0.0 ? upper : x;
    float newton = residual / (2.0 * (INV_SQRT_PI * gauss) * visible);
    float halley = newton / max(1.0 + newton * (x + 0.5 * s / visible), 0.5);
    float next = x - halley;
    // A step of zero stays at a border of the bracket, so the borders are inside.
    next = (next >= lower && next <= upper) ? next : 0.5 * (lower + upper);
    // The residual's own rounding moves x by this much.
    done = abs(next - x) <= 2.0e-7 * max(abs(x), 2.0);
    x = next;
    if (done) break;
  }
  return x;
}

/// Unit half vector with density G1(wo) D(wh) max(0, wo.wh) / cos(theta_o), G1 exact.
/// E. Heitz, E. d'Eon, "Importance Sampling Microfacet-Based BSDFs using the Distribution of
/// Visible Normals", EGSR 2014.
vec3 beckmann_sample_visible(vec3 wo, float alpha, vec2 u) {
  vec2 v = max(u, vec2(2.98023224e-8));  // 2^-25, half a step: no infinite slope
  vec3 w = normalize_safe(vec3(alpha * wo.x, alpha * wo.y, wo.z));
  float s = sqrt(w.x * w.x + w.y * w.y);
  vec2 axis = s > 0.0 ? w.xy / s : vec2(1.0, 0.0);
  float along = alpha * beckmann_visible_slope(s, w.z, v.x);
  float across = alpha * erfinv_quantile(v.y);
  vec2 slope = vec2(axis.x * along - axis.y * across, axis.y * along + axis.x * across);
  return normalize_safe(vec3(-slope.x, -slope.y, 1.0));
}

#endif
