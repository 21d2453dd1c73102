/* direct_ems, direct_mats, direct_mis, direct_whitted, whitted, path, path_mats, path_ems,
   path_nee, path_mis: light transport by paths from the camera.

   The names differ in how direct light is estimated at each surface interaction,

   - ems, nee: by sampling an emitter;
   - mats: by sampling the BSDF;
   - mis: by both, weighted (path is path_mis);
   - whitted: by sampling every emitter; paths then go on at delta lobes (mirror, dielectric) alone,

   and in how many interactions there are: one for direct_*, `maxDepth` for the others. At a delta
   lobe, all of them follow the lobe.

   Emission that the camera sees directly is added once, unweighted. Russian roulette:
   docs/reference/sampling.md. */
#include "path_step.glsl"
#include "../lib/bsdf.glsl"
#include "../lib/color.glsl"
#include "../lib/emitter.glsl"

/// With every emitter sampled, as in Nori.
const float WHITTED_SURVIVAL = 0.95;

/// Probability that a path goes on after interaction k, and the number of words that let it.
struct Survival {
  float probability;
  uint words;  // 0: all
};

/// The probability becomes a whole number of words, so that it is the one that is used.
Survival survival_of(float q) {
  if (q >= 1.0) return Survival(1.0, 0u);
  uint words = max(uint(max(q, 0.0) * 4294967296.0), 1u);
  return Survival(float(words) * 2.3283064365386963e-10, words);
}

/// Largest probability of going on (docs/reference/sampling.md, "Roulette").
float largest_survival(uint k) { return 1.0 - 2.0 / float(k + 60u); }

/// Weight of a sample of density `used` where `other` would have sampled it too.
float mis_weight(float used, float other) {
  float a = used;
  float b = other;
  if (POWER_HEURISTIC) {
    // Divided by the larger first: squares of densities overflow.
    float largest = max(a, b);
    a = (a / largest) * (a / largest);
    b = (b / largest) * (b / largest);
  }
  return used > 0.0 ? a / (a + b) : 0.0;
}

/// What f times the radiance of an emitter sample is weighted by.
float light_weight(EmitterSample e, float cosine, float bsdf_pdf) {
  bool by_both = MATERIAL_SAMPLING && !e.delta;
  float weight = by_both ? mis_weight(float(CANDIDATES) * e.pdf, bsdf_pdf) : 1.0;
  return weight * (cosine / e.pdf);
}

/// Emission at the end of a path's ray, weighted; bounce 0 is the camera's ray.
vec3 weighted_emission(FoundEmission found, float bsdf_pdf_used, uint bounce) {
  float weight = 1.0;
  if (EMITTER_SAMPLING)
    weight = MATERIAL_SAMPLING ? mis_weight(bsdf_pdf_used, float(CANDIDATES) * found.pdf) : 0.0;
  bool only_way =
      bounce == 0u || ((BSDF_FLAGS_SOME & BSDF_DELTA) != 0u && bsdf_pdf_used == DELTA_PDF);
  return only_way ? found.radiance : weight * found.radiance;
}

/// Shadow ray for one emitter sample at s, of whose direction the BSDF has the value f and the
/// density; gain: what it stands for beside itself; has_shadow is false where it could contribute
/// nothing.
void add_direct_light(inout PathStep step, Surface s, EmitterSample e, float cosine, vec3 f,
                      float bsdf_pdf, float gain) {
  vec3 contribution =
      step.path.throughput.rgb * f * e.radiance * (gain * light_weight(e, cosine, bsdf_pdf));
  vec3 from = offset_ray_origin(s.position, s.magnitude, s.ng, e.d);
  vec4 direction = e.at_infinity ? vec4(e.d, LARGEST) : vec4(e.point - from, 1.0);
  step.shadow = RayRecord(vec4(from, 0.0), direction);
  step.contribution = contribution;
  // Written so that NaN is kept: such a sample is to be counted as bad, not to vanish here.
  bool dark = contribution.x == 0.0 && contribution.y == 0.0 && contribution.z == 0.0;
  step.has_shadow = e.pdf > 0.0 && !dark;
}

/// The ray that continues the path from s at interaction k along a sample of the BSDF.
void continue_path(inout PathStep step, Surface s, Receiver at, Frame shading, BsdfSample b,
                   uint roulette_bits, uint k) {
  vec3 throughput = step.path.throughput.rgb * b.weight;
  step.path.radiance.w *= b.eta2;
  float q = 1.0;
  if (ROULETTE) {
    float largest = max(throughput.x, max(throughput.y, throughput.z));
    largest *= step.path.radiance.w;
    q = k >= ROULETTE_FIRST ? min(largest_survival(k), largest) : 1.0;
  }
  if (EVERY_EMITTER) q = WHITTED_SURVIVAL;
  Survival survival = survival_of(q);
  bool survives = survival.words == 0u || roulette_bits < survival.words;
  bool dark = throughput.x == 0.0 && throughput.y == 0.0 && throughput.z == 0.0;
  vec3 d = to_world(shading, b.wi);
  step.path.throughput = vec4(throughput / survival.probability, b.pdf);
  step.next.origin = vec4(offset_ray_origin(s.position, s.magnitude, s.ng, d), 0.0);
  step.next.direction = vec4(d, LARGEST);
  if (LIGHT_TREE) {
    vec2 coded = coded_normal(at.normal);
    step.next.origin.w = coded.x;
    step.next.direction.w = coded.y;
  }
  step.alive = step.alive && survives && !dark;
}

/// The words of an emitter sample, and what its contribution is multiplied by.
struct Candidate {
  uvec4 bits;
  float gain;
};

/// The words of candidate i, made of the first one's.
uvec4 candidate_bits(uvec4 bits, uint i) {
  uvec2 words = candidate_words(uvec2(bits[EMITTER_U], bits[EMITTER_V]), i, CANDIDATES);
  bits[EMITTER_U] = words.x;
  bits[EMITTER_V] = words.y;
  return bits;
}

/// One of the candidates of interaction k, by the luminance of what it would contribute if nothing
/// stood in its way (J. Talbot, D. Cline, P. Egbert, "Importance Resampling for Global
/// Illumination", EGSR 2005).
Candidate choose_candidate(BsdfRecord bsdf, Frame shading, vec3 wo, Surface s, Receiver at,
                           SampleId id, uint k) {
  uvec4 bits = random_block(id, bounce_block(k) + BOUNCE_EMITTER);
  if (CANDIDATES == 1u) return Candidate(bits, 1.0);
  float weights[LARGEST_CANDIDATES];
  float sum = 0.0;
  for (uint i = 0u; i < CANDIDATES; ++i) {
    EmitterSample e = sample_emitters(s, at, candidate_bits(bits, i));
    vec3 wi = to_local(shading, e.d);
    float pdf = MATERIAL_SAMPLING ? bsdf_pdf(bsdf, wo, wi) : 0.0;
    float light = luminance(bsdf_eval(bsdf, wo, wi) * e.radiance);
    float weight = e.pdf > 0.0 ? light * light_weight(e, abs(wi.z), pdf) : 0.0;
    weights[i] = weight;
    sum += weight;
  }
  float x = unit_float(random_block(id, BLOCK_CANDIDATES + k - 1u).x) * sum;
  uint chosen = 0u;
  float before = 0.0;
  for (uint i = 0u; i + 1u < CANDIDATES; ++i) {
    before += weights[i];
    chosen += x >= before ? 1u : 0u;
  }
  float gain = sum / (float(CANDIDATES) * weights[chosen]);
  return Candidate(candidate_bits(bits, chosen), sum > 0.0 ? gain : 1.0);
}

/// The emitter sample of interaction k where every emitter is sampled: of the pass'.
EmitterSample sample_of_pass(Surface s, SampleId id, uint k) {
  uint block = BLOCK_EVERY_EMITTER + (k - 1u) * frame.emitter_count + pass_constants.emitter;
  return sample_emitter(fetch_emitter(pass_constants.emitter), s, random_block(id, block));
}

/// Interaction k = bounce + 1 of a path whose ray, as it was queued, has found `hit`.
PathStep shade_path(PathRecord path, RayRecord ray, HitRecord hit, SampleId id, uint bounce) {
  PathStep step = unchanged_path(path, ray);
  bool missed = hit.triangle == NONE;
  vec3 d = ray.direction.xyz;
  Surface s = surface_at(missed ? 0u : hit.triangle, hit.b1, hit.b2);
  Receiver from = receiver_of(ray);
  FoundEmission found = emission_of_surface(s, d, hit.t, from);
  FoundEmission sky =
      HAS_EMITTER(environment) ? emission_of_environment(d, from) : FoundEmission(vec3(0.0), 0.0);
  found.radiance = missed ? sky.radiance : found.radiance;
  found.pdf = missed ? sky.pdf : found.pdf;
  step.path.radiance.rgb +=
      path.throughput.rgb * weighted_emission(found, path.throughput.w, bounce);

  if (LAST_BOUNCE) return step;

  uint k = bounce + 1u;
  Frame shading = frame_from_normal(s.ns);
  vec3 wo = to_local(shading, -d);
  BsdfRecord bsdf = textured_bsdf(fetch_bsdf(fetch_mesh(s.mesh).bsdf), s.uv);
  bool visible = wo.z > 0.0 || HAS_FLAG(bsdf.flags, BSDF_TRANSMITS);
  bool scatters = !missed && visible;
  Receiver at = Receiver(s.position, HAS_FLAG(bsdf.flags, BSDF_TRANSMITS) ? vec3(0.0) : s.ns);
  EmitterSample e;
  vec3 wi = wo;
  float gain = 1.0;
  if (EMITTER_SAMPLING) {
    if (EVERY_EMITTER) {
      e = sample_of_pass(s, id, k);
    } else {
      Candidate chosen = choose_candidate(bsdf, shading, wo, s, at, id, k);
      gain = chosen.gain;
      e = sample_emitters(s, at, chosen.bits);
    }
    wi = to_local(shading, e.d);
  }
  uvec4 bits = random_block(id, bounce_block(k) + BOUNCE_BSDF);
  BsdfAnswers answers = bsdf_answers(bsdf, wo, wi, bsdf_numbers(bits));
  if (EMITTER_SAMPLING) {
    add_direct_light(step, s, e, abs(wi.z), answers.f, answers.pdf, gain);
    step.has_shadow = step.has_shadow && scatters;
  }
  if (ONLY_BOUNCE) return step;
  // After the last interaction only emission is looked for, which emitter sampling alone needs at
  // delta lobes only.
  bool delta = HAS_FLAG(bsdf.flags, BSDF_DELTA);
  step.alive = scatters && (MATERIAL_SAMPLING || delta || (k < frame.max_depth && !EVERY_EMITTER));
  continue_path(step, s, at, shading, answers.next, bits[BSDF_ROULETTE], k);
  return step;
}
