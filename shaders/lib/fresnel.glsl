// Fresnel reflectances (spec: exact dielectric, Schlick).
#ifndef FACET_FRESNEL_GLSL
#define FACET_FRESNEL_GLSL

/// Schlick's approximation 1994: r0 at normal incidence, c the cosine between direction and half vector.
vec3 fresnel_schlick(vec3 r0, float c) {
  float m = max(1.0 - c, 0.0);
  float m2 = m * m;
  return r0 + (vec3(1.0) - r0) * (m2 * m2 * m);
}

/// Unpolarised reflectance between two dielectrics; c is the cosine on the exterior side (negative: seen from inside).
/// 1 beyond the critical angle, 0 for equal indices.
float fresnel_dielectric(float c, float ext_ior, float int_ior) {
  float eta_i = c < 0.0 ? int_ior : ext_ior;
  float eta_t = c < 0.0 ? ext_ior : int_ior;
  float ci = min(abs(c), 1.0);
  float ratio = eta_i / eta_t;
  float sin2_t = ratio * ratio * ((1.0 - ci) * (1.0 + ci));
  float ct = sqrt(max(1.0 - sin2_t, 0.0));
  float rs = (eta_i * ci - eta_t * ct) / (eta_i * ci + eta_t * ct);
  float rp = (eta_t * ci - eta_i * ct) / (eta_t * ci + eta_i * ct);
  float f = 0.5 * (rs * rs + rp * rp);
  f = sin2_t >= 1.0 ? 1.0 : f;
  return eta_i == eta_t ? 0.0 : f;
}

#endif
