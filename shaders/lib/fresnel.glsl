// Fresnel reflectances (spec: exact dielectric, Schlick).
#ifndef FACET_FRESNEL_GLSL
#define FACET_FRESNEL_GLSL

/// Schlick's approximation 1994: r0 at normal incidence, c the cosine between direction and half
/// vector.
vec3 fresnel_schlick(vec3 r0, float c) {
  float m = max(1.0 - c, 0.0);
  float m2 = m * m;
  return r0 + (vec3(1.0) - r0) * (m2 * m2 * m);
}

/// Unpolarised reflectance of a conductor of complex index eta + i k (over that of the other side),
/// per channel; c: cosine of the angle of incidence. M. Born, E. Wolf, "Principles of Optics",
/// section 13.4, with the numerator of the first amplitude written in the difference of the
/// indices, so that nothing cancels where they are nearly equal.
vec3 fresnel_conductor(vec3 eta, vec3 k, float c) {
  float cos2 = min(c * c, 1.0);
  float sin2 = max((1.0 - c) * (1.0 + c), 0.0);
  vec3 less = eta - vec3(1.0);
  vec3 more = eta + vec3(1.0);
  vec3 k2 = k * k;
  // (a + i b)^2 = (eta + i k)^2 - sin^2; both forms of a^2 are sums where nothing cancels.
  vec3 t = (less * more - k2) + vec3(cos2);
  vec3 ek2 = (eta * eta) * k2;
  vec3 length2 = sqrt(t * t + 4.0 * ek2);
  vec3 with_t = length2 + abs(t);
  vec3 larger = 0.5 * with_t;
  vec3 smaller = 2.0 * ek2 / max(with_t, vec3(1.0e-30));
  vec3 a2 = vec3(t.x >= 0.0 ? larger.x : smaller.x, t.y >= 0.0 ? larger.y : smaller.y,
                 t.z >= 0.0 ? larger.z : smaller.z);
  vec3 ac = 2.0 * sqrt(a2) * c;
  // 0 only where the indices are equal and the angle is grazing.
  vec3 sum = max((length2 + vec3(cos2)) + ac, vec3(1.0e-30));
  vec3 rs = ((less * less + k2) / sum) * ((more * more + k2) / sum);
  vec3 product = length2 * cos2 + vec3(sin2 * sin2);
  vec3 rp = (product - ac * sin2) / (product + ac * sin2);
  return 0.5 * rs * (vec3(1.0) + rp);
}

/// Shares of the light that meets an interface; their sum is 1 but for rounding, which each has of
/// its own: neither is what the other leaves.
struct FresnelShares {
  float reflected;
  float transmitted;
};

/// Unpolarised reflectance and transmittance between two dielectrics; c is the cosine on the
/// exterior side (negative: seen from inside). All is reflected beyond the critical angle, nothing
/// between equal indices.
FresnelShares fresnel_shares(float c, float ext_ior, float int_ior) {
  float eta_i = c < 0.0 ? int_ior : ext_ior;
  float eta_t = c < 0.0 ? ext_ior : int_ior;
  float ci = min(abs(c), 1.0);
  // Written in the difference of the indices, so that nothing cancels where they are nearly equal:
  // (eta_t ct)^2 = eta_t^2 - eta_i^2 + (eta_i ci)^2, rs = (eta_i^2 - eta_t^2) / a^2, rp = (eta_t^2
  // - eta_i^2) (ci^2 (1 + r) - r) / b^2, r = (eta_i / eta_t)^2.
  float d = (eta_t - eta_i) * (eta_t + eta_i);
  float ratio = eta_i / eta_t;
  float r = ratio * ratio;
  float p = eta_i * ci;
  float w2 = d + p * p;
  float w = sqrt(max(w2, 0.0));
  float a = p + w;
  float b = eta_t * ci + ratio * w;
  float rs = d / a / a;
  float rp = d * (ci * ci * (1.0 + r) - r) / b / b;
  float f = min(0.5 * (rs * rs + rp * rp), 1.0);
  // 1 less the squares of the amplitudes, by a^2 - (eta_i ci - eta_t ct)^2 = 4 eta_i ci eta_t ct.
  float q = p * w;
  float t = min(2.0 * (q / a / a + q / b / b), 1.0);
  f = w2 <= 0.0 ? 1.0 : f;
  t = w2 <= 0.0 ? 0.0 : t;
  return eta_i == eta_t ? FresnelShares(0.0, 1.0) : FresnelShares(f, t);
}

/// The reflectance alone.
float fresnel_dielectric(float c, float ext_ior, float int_ior) {
  return fresnel_shares(c, ext_ior, int_ior).reflected;
}

#endif
