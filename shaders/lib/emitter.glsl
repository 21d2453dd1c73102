// Choice among the emitters, and dispatch over the kinds that the scene has.
#ifndef FACET_EMITTER_GLSL
#define FACET_EMITTER_GLSL
#include "choice.glsl"
#include "light_tree.glsl"
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
    s = area_sample(e, e.first_triangle, e.triangle_count, from, bits[EMITTER_U], bits[EMITTER_V],
                    bits[EMITTER_SECOND_FILL]);
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

/// The same towards what the light tree or, beside it, the environment sends to the receiver.
EmitterSample sample_light_tree(Surface from, Receiver at, uvec4 bits) {
  EmitterSample s = EmitterSample(vec3(0.0, 0.0, 1.0), vec3(0.0), 0.0, vec3(0.0), true, false);
  uint word = bits[EMITTER_U];
  float share = HAS_EMITTER(environment) ? environment_share(at) : 0.0;
  bool sky = HAS_EMITTER(environment) && choose_first(word, share, bits[EMITTER_FIRST_FILL]);
  bits[EMITTER_U] = word;
  ChosenLight chosen = choose_light(at, bits[EMITTER_U], bits[EMITTER_FIRST_FILL]);
  LightNode leaf = chosen.node;
  bool is_point = HAS_EMITTER(pointlight) && leaf.count == LIGHT_POINT;
  if (HAS_EMITTER(area)) {
    // Where the tree has found nothing, any triangle is as good.
    bool has = leaf.count > 0u && !is_point && !sky;
    s = area_sample(fetch_emitter(0u), has ? leaf.first : 0u, has ? leaf.count : 1u, from,
                    bits[EMITTER_U], bits[EMITTER_V], bits[EMITTER_SECOND_FILL]);
  }
  if (HAS_EMITTER(pointlight)) {
    EmitterSample p = pointlight_sample(fetch_emitter(is_point ? leaf.first : 0u), from);
    if (is_point || !HAS_EMITTER(area)) s = p;
  }
  s.pdf *= (1.0 - share) * chosen.probability;
  if (HAS_EMITTER(environment)) {
    EmitterSample e = environment_sample(word, bits[EMITTER_V], bits[EMITTER_SECOND_FILL],
                                         bits[EMITTER_FIRST_FILL] ^ bits[EMITTER_SECOND_FILL]);
    e.pdf *= share;
    if (sky) s = e;
  }
  return s;
}

/// A direction from a surface towards some emitter; pdf includes the choice of the emitter.
EmitterSample sample_emitters(Surface from, Receiver at, uvec4 bits) {
  if (LIGHT_TREE) return sample_light_tree(from, at, bits);
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
/// direction from where it comes from.
struct FoundEmission {
  vec3 radiance;
  float pdf;  // sr^-1
};

FoundEmission emission_of_surface(Surface s, vec3 d, float distance, Receiver from) {
  FoundEmission f = FoundEmission(vec3(0.0), 0.0);
  if (!HAS_EMITTER(area)) return f;
  uint index = fetch_mesh(s.mesh).emitter;
  EmitterRecord e = fetch_emitter(index == NONE ? 0u : index);
  bool emits = index != NONE;
  f.radiance = emits ? area_eval(e, s, d) : vec3(0.0);
  // Nothing asks by what density the camera would have sampled.
  if (CAMERA_BOUNCE) return f;
  EmitterPlace place = emitter_place_of(e, s);
  float chosen = LIGHT_TREE ? light_probability(emits ? place.leaf : 0u, from) : e.probability;
  if (LIGHT_TREE && HAS_EMITTER(environment)) chosen *= 1.0 - environment_share(from);
  // What is no emitter's has a place somewhere else.
  if (emits) f.pdf = found_area_pdf(place.triangle, s, d, distance, from.position) * chosen;
  return f;
}

FoundEmission emission_of_environment(vec3 d, Receiver from) {
  if (!HAS_EMITTER(environment)) return FoundEmission(vec3(0.0), 0.0);
  if (CAMERA_BOUNCE) return FoundEmission(environment_eval(d), 0.0);
  float chosen =
      LIGHT_TREE ? environment_share(from) : fetch_emitter(frame.environment_emitter).probability;
  return FoundEmission(environment_eval(d), environment_pdf(d) * chosen);
}

#endif
