// Dispatch over the BSDFs that the scene has. Those that do not transmit are black from behind and
// towards behind.
#ifndef FACET_BSDF_GLSL
#define FACET_BSDF_GLSL
#include "specialization.glsl"
#include "bsdf_models.glsl"

/// True for the BSDF of this id; known when the kernel is specialised if the scene has none of it,
/// or nothing else.
#define IS_BSDF(b, id) ((BSDF_MASK & (1u << id)) != 0u && (BSDF_MASK == (1u << id) || b.type == id))

/// Whether the BSDF scatters between these directions at all.
bool bsdf_allows(BsdfRecord b, vec3 wo, vec3 wi) {
  if (HAS_FLAG(b.flags, BSDF_DELTA)) return false;
  if (HAS_FLAG(b.flags, BSDF_TRANSMITS)) return wo.z != 0.0 && wi.z != 0.0;
  return wo.z > 0.0 && wi.z > 0.0;
}

/// f(wo, wi) in sr^-1; both directions in the shading frame.
vec3 bsdf_eval(BsdfRecord b, vec3 wo, vec3 wi) {
  vec3 f = vec3(0.0);
#define FACET_CASE(name, Type, id) \
  if (IS_BSDF(b, id)) f = name##_eval(b, wo, wi);
  FACET_BSDF_LIST(FACET_CASE)
#undef FACET_CASE
  return bsdf_allows(b, wo, wi) ? f : vec3(0.0);
}

/// Density of wi under bsdf_sample, sr^-1.
float bsdf_pdf(BsdfRecord b, vec3 wo, vec3 wi) {
  float pdf = 0.0;
#define FACET_CASE(name, Type, id) \
  if (IS_BSDF(b, id)) pdf = name##_pdf(b, wo, wi);
  FACET_BSDF_LIST(FACET_CASE)
#undef FACET_CASE
  return bsdf_allows(b, wo, wi) ? pdf : 0.0;
}

/// A sample as a BSDF makes it, with weight 0 where it is rejected.
BsdfSample allowed_sample(BsdfRecord b, vec3 wo, BsdfSample s) {
  bool valid = HAS_FLAG(b.flags, BSDF_TRANSMITS) || (wo.z > 0.0 && s.wi.z > 0.0);
  s.weight = valid ? s.weight : vec3(0.0);
  return s;
}

/// Direction wi with its weight f |cos| / pdf; weight 0 where the sample is rejected.
BsdfSample bsdf_sample(BsdfRecord b, vec3 wo, BsdfNumbers n) {
  BsdfSample s = bsdf_sample_none();
#define FACET_CASE(name, Type, id) \
  if (IS_BSDF(b, id)) s = name##_sample(b, wo, n);
  FACET_BSDF_LIST(FACET_CASE)
#undef FACET_CASE
  return allowed_sample(b, wo, s);
}

/// All that an interaction asks of a BSDF.
struct BsdfAnswers {
  vec3 f;           // bsdf_eval
  float pdf;        // bsdf_pdf
  BsdfSample next;  // bsdf_sample
};

/// As the three functions, as far as the integrator wants to know; in one branch a BSDF, so that
/// what they have in common is computed once.
BsdfAnswers bsdf_answers(BsdfRecord b, vec3 wo, vec3 wi, BsdfNumbers n) {
  BsdfAnswers a = BsdfAnswers(vec3(0.0), 0.0, bsdf_sample_none());
#define FACET_CASE(name, Type, id)                                            \
  if (IS_BSDF(b, id)) {                                                       \
    if (EMITTER_SAMPLING) a.f = name##_eval(b, wo, wi);                       \
    if (EMITTER_SAMPLING && MATERIAL_SAMPLING) a.pdf = name##_pdf(b, wo, wi); \
    if (!ONLY_BOUNCE) a.next = name##_sample(b, wo, n);                       \
  }
  FACET_BSDF_LIST(FACET_CASE)
#undef FACET_CASE
  bool allows = bsdf_allows(b, wo, wi);
  a.f = allows ? a.f : vec3(0.0);
  a.pdf = allows ? a.pdf : 0.0;
  a.next = allowed_sample(b, wo, a.next);
  return a;
}

#endif
