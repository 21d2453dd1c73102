// Choice of what to sample among all that emits from a place, by what it can send to a point
// (docs/reference/sampling.md, "Light tree").
#ifndef FACET_LIGHT_TREE_GLSL
#define FACET_LIGHT_TREE_GLSL
#include "choice.glsl"
#include "records.glsl"
#include "specialization.glsl"

/// A point that light is wanted at.
struct Receiver {
  vec3 position;
  vec3 normal;  // unit, on the side that is lit; 0 where both are
};

/// cos(max(0, a - b)) and the sine, from those of a and b in [0, pi].
vec2 narrowed(vec2 a, vec2 b) {
  bool within = a.x >= b.x;
  return within ? vec2(1.0, 0.0) : vec2(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y);
}

/// Cosine and sine of an angle in [0, pi].
vec2 with_sine(float cosine) { return vec2(cosine, sqrt(max(1.0 - cosine * cosine, 0.0))); }

/// What the sources below a node may send to a point at most, up to a factor that all nodes have in
/// common: 0 only where it is nothing.
float light_importance(LightNode node, Receiver at) {
  vec3 to = node.sphere.xyz - at.position;
  float d2 = dot3(to, to);
  float r2 = node.sphere.w * node.sphere.w;
  float share = d2 > r2 ? r2 / d2 : 1.0;
  // Of the angle that the sphere fills; from within it, of every direction.
  vec2 filled = share < 1.0 ? vec2(sqrt(1.0 - share), sqrt(share)) : vec2(-1.0, 0.0);
  vec3 w = to / sqrt(max(d2, 1.0e-37));
  vec2 emitted = narrowed(with_sine(-dot3(node.cone.xyz, w)), with_sine(node.cone.w));
  float emitter_cosine = narrowed(emitted, filled).x;
  float receiver_cosine = narrowed(with_sine(dot3(at.normal, w)), filled).x;
  receiver_cosine = at.normal == vec3(0.0) ? 1.0 : receiver_cosine;
  float cosines = max(emitter_cosine + LIGHT_SLACK, 0.0) * max(receiver_cosine + LIGHT_SLACK, 0.0);
  return node.energy * cosines / max(max(d2, r2), 1.0e-37);
}

/// A node of the tree and the probability of its choice; 0 where nothing can light the point.
struct ChosenLight {
  LightNode node;
  float probability;
};

/// Goes from the root to a leaf; leaves the remainder of the word.
ChosenLight choose_light(Receiver at, inout uint word, uint fill) {
  LightNode node = fetch_light_node(0u);
  float probability = 1.0;
  uint k = 0u;
  while (node.count == 0u && k < LIGHT_TREE_DEPTH) {
    LightNode a = fetch_light_node(node.first);
    LightNode b = fetch_light_node(node.first + 1u);
    float of_a = light_importance(a, at);
    float of_b = light_importance(b, at);
    float share = first_share(of_a, of_b);
    fill = fill * LIGHT_FILL_FACTOR + LIGHT_FILL_STEP;
    bool first = choose_first(word, share, fill);
    probability *= of_a + of_b > 0.0 ? (first ? share : 1.0 - share) : 0.0;
    node.sphere = first ? a.sphere : b.sphere;
    node.cone = first ? a.cone : b.cone;
    node.energy = first ? a.energy : b.energy;
    node.parent = first ? a.parent : b.parent;
    node.first = first ? a.first : b.first;
    node.count = first ? a.count : b.count;
    ++k;
  }
  return ChosenLight(node, probability);
}

/// Probability with which choose_light comes to a leaf, by its index.
float light_probability(uint leaf, Receiver at) {
  float probability = 1.0;
  uint node = leaf;
  uint k = 0u;
  while (node != 0u && k < LIGHT_TREE_DEPTH) {
    // Siblings lie side by side, the first at an odd place.
    uint first = node - 1u + (node & 1u);
    LightNode a = fetch_light_node(first);
    float of_a = light_importance(a, at);
    float of_b = light_importance(fetch_light_node(first + 1u), at);
    float share = first_share(of_a, of_b);
    probability *= of_a + of_b > 0.0 ? (node == first ? share : 1.0 - share) : 0.0;
    node = a.parent;
    ++k;
  }
  return probability;
}

/// Probability of the environment, where there are other emitters beside it. Neither knows what
/// hides the other, hence the bounds.
float environment_share(Receiver at) {
  float own = frame.environment_irradiance;
  float others = light_importance(fetch_light_node(0u), at);
  float share = own > 0.0 ? min(max(first_share(own, others), 0.25), 0.75) : 0.0;
  return own > 0.0 && others == 0.0 ? 1.0 : share;
}

/// A normal as two numbers, by the octahedral map; 2 stands for none.
vec2 coded_normal(vec3 n) {
  float size = abs(n.x) + abs(n.y) + abs(n.z);
  vec2 p = n.xy / max(size, 1.0e-37);
  vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  vec2 coded = n.z >= 0.0 ? p : folded;
  return size > 0.0 ? coded : vec2(2.0);
}

vec3 decoded_normal(vec2 coded) {
  float z = 1.0 - abs(coded.x) - abs(coded.y);
  vec2 folded =
      (1.0 - abs(coded.yx)) * vec2(coded.x >= 0.0 ? 1.0 : -1.0, coded.y >= 0.0 ? 1.0 : -1.0);
  vec3 n = vec3(z >= 0.0 ? coded : folded, z);
  return coded.x > 1.5 ? vec3(0.0) : n / sqrt(max(dot3(n, n), 1.0e-37));
}

/// Where the ray of a queued path comes from. Its range is unlimited: in place of the range, the
/// ray holds the normal.
Receiver receiver_of(RayRecord queued) {
  return Receiver(queued.origin.xyz, decoded_normal(vec2(queued.origin.w, queued.direction.w)));
}

RayRecord without_normal(RayRecord queued) {
  return RayRecord(vec4(queued.origin.xyz, 0.0), vec4(queued.direction.xyz, LARGEST));
}

#endif
