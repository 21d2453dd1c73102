// Choice among the emitters, and dispatch over the kinds that the scene has.
#ifndef FACET_EMITTER_GLSL
#define FACET_EMITTER_GLSL
#include "choice.glsl"
#include "random.glsl"
#include "records.glsl"
#include "specialization.glsl"
#include "../emitter/area.glsl"
#include "../emitter/environment.glsl"
#include "../emitter/pointlight.glsl"

#define FACET_EMITTER_COUNT(i) fetch_emitter(i).cumulative
FACET_DEFINE_CHOICE(choose_emitter, FACET_EMITTER_COUNT)

/// A direction from a surface towards an emitter, by the words of a block.
EmitterSample sample_emitter(EmitterRecord e, Surface from, uvec4 bits) {
  EmitterSample s = EmitterSample(vec3(0.0, 0.0, 1.0), vec3(0.0), 0.0, vec3(0.0), true, false);
  if (IS_EMITTER(e.type, area)) {
    s = area_sample(e, from, bits[EMITTER_U], bits[EMITTER_V], bits[EMITTER_SECOND_FILL]);
  }
  if (IS_EMITTER(e.type, environment)) {
    s = environment_sample(bits[EMITTER_U], bits[EMITTER_V], bits[EMITTER_SECOND_FILL],
                           bits[EMITTER_FIRST_FILL] ^ bits[EMITTER_SECOND_FILL]);
  }
  if (IS_EMITTER(e.type, pointlight)) s = pointlight_sample(e, from);
  // Without power, an emitter has no density to sample by.
  s.pdf = e.probability > 0.0 ? s.pdf : 0.0;
  return s;
}

/// A direction from a surface towards some emitter; pdf includes the choice of the emitter.
EmitterSample sample_emitters(Surface from, uvec4 bits) {
  uint word = choice_word(bits[EMITTER_U]);
  if (!SEVERAL_EMITTERS) {
    bits[EMITTER_U] = word;
    return sample_emitter(fetch_emitter(0u), from, bits);
  }
  uint chosen = choose_emitter(0u, frame.emitter_count - 1u, word);
  EmitterRecord e = fetch_emitter(chosen);
  uint begin = chosen > 0u ? fetch_emitter(chosen - 1u).cumulative : 0u;
  bits[EMITTER_U] = remainder_word(word, begin, e.cumulative, bits[EMITTER_FIRST_FILL]);
  EmitterSample s = sample_emitter(e, from, bits);
  s.pdf *= e.probability;
  return s;
}

/// Emission found by a ray, and the density with which sample_emitters would have sampled its
/// direction.
struct FoundEmission {
  vec3 radiance;
  float pdf;  // sr^-1
};

FoundEmission emission_of_surface(Surface s, vec3 d, float distance) {
  FoundEmission f = FoundEmission(vec3(0.0), 0.0);
  if (!HAS_EMITTER(area)) return f;
  uint index = fetch_mesh(s.mesh).emitter;
  EmitterRecord e = fetch_emitter(index == NONE ? 0u : index);
  bool emits = index != NONE;
  f.radiance = emits ? area_eval(e, s, d) : vec3(0.0);
  f.pdf = emits ? area_pdf(e, s, d, distance) * e.probability : 0.0;
  return f;
}

FoundEmission emission_of_environment(vec3 d) {
  if (!HAS_EMITTER(environment)) return FoundEmission(vec3(0.0), 0.0);
  return FoundEmission(environment_eval(d),
                       environment_pdf(d) * fetch_emitter(frame.environment_emitter).probability);
}

#endif
