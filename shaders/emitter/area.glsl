/* area: a mesh that emits from one side.

   Emits where ns.w > 0, ns being the interpolated normal; points are sampled uniformly by area, two
   neighbouring triangles of one area as one, and the density per solid angle is p d^2 / (A |ng.w|)
   with the geometric normal ng, p being the probability of the triangle and A its area; or
   (areaSampling) uniformly by the solid angle that the triangles fill. It must not lie in the plane
   of another surface that it overlaps: rounding decides which of the two a ray meets. */
#include "parameters.glsl"
#include "../lib/emitter_sample.glsl"
#include "../lib/choice.glsl"
#include "../lib/random.glsl"
#include "../lib/seen_triangle.glsl"
#include "../lib/surface.glsl"
#include "../lib/texture.glsl"
#include "../lib/warp.glsl"

/// Radiance leaving surface s towards -d.
vec3 area_eval(EmitterRecord e, Surface s, vec3 d) {
  vec3 radiance = area_radiance(e);
  if (TEXTURE_KINDS != 0u) radiance = radiance * texture_value(e.texture_a, vec3(1.0), s.uv);
  return dot3(s.ns, d) < 0.0 ? radiance : vec3(0.0);
}

/// Where the triangle of an emitter that s lies on has its record, and in which leaf of a light
/// tree it is.
EmitterPlace emitter_place_of(EmitterRecord e, Surface s) {
  uint i = e.first_triangle + (s.index - e.first_index);
  if (LIGHT_TREE) return fetch_emitter_place(i);
  return EmitterPlace(i, NONE, 0u, 0u);
}

/// Density, sr^-1, of sampling the point of s at the given distance along d, by the density of the
/// points of its triangle, m^-2.
float area_pdf(float density, Surface s, vec3 d, float distance) {
  float c = abs(dot3(s.ng, d));
  // Finite, so that the MIS weight of a vanishing emitter is no quotient of infinities.
  return c > 0.0 ? min((distance * density) * (distance / c), 1.0e37) : 0.0;
}

#define FACET_TRIANGLE_COUNT(i) fetch_emitter_triangle(i).cumulative
FACET_DEFINE_CHOICE(choose_emitter_triangle, FACET_TRIANGLE_COUNT)

/// A point of a triangle.
struct TrianglePoint {
  uint triangle;        // place in the BVH
  vec2 b;               // barycentric weights of its second and third vertex
  float density;        // m^-2, or sr^-1
  bool by_solid_angle;  // which of them
};

/// The point (u, v) of two triangles that have an edge in common.
TrianglePoint point_of_two(EmitterTriangle first, EmitterTriangle second, vec2 u) {
  bool in_first = u.x + u.y <= 1.0;
  // Of the corner that the edge misses and, in winding order, of the others.
  vec3 weights =
      in_first ? vec3(1.0 - u.x - u.y, u.x, u.y) : vec3(u.x + u.y - 1.0, 1.0 - u.x, 1.0 - u.y);
  uint corner = (in_first ? first.corner : second.corner) & CORNER_MASK;
  vec2 b = corner == 0u ? weights.yz : (corner == 1u ? weights.xy : weights.zx);
  return TrianglePoint(in_first ? first.triangle : second.triangle, b,
                       in_first ? first.density : second.density, false);
}

bool is_one_of_two(EmitterTriangle t) {
  return EMITTER_PIECES == 2u || (EMITTER_PIECES == 3u && t.corner != NO_CORNER);
}

/// Whether a piece's points are sampled by solid angle where it fills this one.
bool is_sampled_as_seen(float solid_angle) {
  return SOLID_ANGLE && solid_angle >= SMALLEST_SEEN && solid_angle <= LARGEST_SEEN;
}

/// Density, sr^-1, of the points of a triangle that are sampled by solid angle; share: of the
/// choice between two.
float seen_density(EmitterTriangle t, SeenTriangle seen, float share) {
  // Of the piece's choice; of two triangles, the density by area has half of it.
  float probability = t.density * seen.area * (is_one_of_two(t) ? 2.0 : 1.0);
  return probability * (share / seen.solid_angle);
}

/// A piece as it is seen from a point: its two triangles, or its only one as the second.
struct SeenPiece {
  SeenTriangle first;
  SeenTriangle second;
  float first_share;        // of the choice between the two
  bool is_sampled_as_seen;  // or by area
};

SeenTriangle see_triangle(uint triangle, vec3 from) {
  Vertices v = fetch_vertices(triangle, triangle_name(triangle).corners);
  return see_corners(v.v0, v.v1, v.v2, from);
}

/// first is read of two triangles alone.
SeenPiece see_piece(EmitterTriangle first, EmitterTriangle second, vec3 from) {
  bool two = is_one_of_two(second);
  SeenPiece piece;
  piece.second = see_triangle(second.triangle, from);
  piece.first = see_triangle(two ? first.triangle : second.triangle, from);
  float of_first = two ? piece.first.solid_angle : 0.0;
  piece.first_share = first_share(of_first, piece.second.solid_angle);
  piece.is_sampled_as_seen = is_sampled_as_seen(piece.second.solid_angle + of_first);
  return piece;
}

/// The point (u, v) of a piece as it is seen from a point; `otherwise` where it is not sampled so.
/// first is read of two triangles alone.
TrianglePoint point_as_seen(EmitterTriangle first, EmitterTriangle second, vec3 from, uint u,
                            uint v, uint fill, TrianglePoint otherwise) {
  SeenPiece piece = see_piece(first, second, from);
  if (!piece.is_sampled_as_seen) return otherwise;
  bool in_first = choose_first(u, piece.first_share, fill * LIGHT_FILL_FACTOR + LIGHT_FILL_STEP);
  vec2 square = vec2(unit_float(u), unit_float(v));
  if (in_first)
    return TrianglePoint(first.triangle, seen_point(piece.first, square),
                         seen_density(first, piece.first, piece.first_share), true);
  return TrianglePoint(second.triangle, seen_point(piece.second, square),
                       seen_density(second, piece.second, 1.0 - piece.first_share), true);
}

/// A point of some emitter triangles for a surface at `from`; u, v: words, fill: that of u.
TrianglePoint area_point(uint first, uint count, vec3 from, uint u, uint v, uint fill) {
  uint word = choice_word(u);
  uint chosen = choose_emitter_triangle(first, first + max(count, 1u) - 1u, word);
  EmitterTriangle triangle = fetch_emitter_triangle(chosen);
  EmitterTriangle before = fetch_emitter_triangle(chosen > first ? chosen - 1u : chosen);
  uint begin = chosen > first ? before.cumulative : 0u;
  u = remainder_word(word, begin, triangle.cumulative, fill);
  vec2 square = vec2(unit_float(u), unit_float(v));
  TrianglePoint point =
      is_one_of_two(triangle)
          ? point_of_two(before, triangle, square)
          : TrianglePoint(triangle.triangle, square_to_triangle(square), triangle.density, false);
  return SOLID_ANGLE ? point_as_seen(before, triangle, from, u, v, fill, point) : point;
}

/// Density, sr^-1, of finding the point of s, which is on emitter triangle i, at the given distance
/// along d from a point.
float found_area_pdf(uint i, Surface s, vec3 d, float distance, vec3 from) {
  EmitterTriangle t = fetch_emitter_triangle(i);
  float by_area = area_pdf(t.density, s, d, distance);
  if (!SOLID_ANGLE) return by_area;
  bool is_first = is_one_of_two(t) && (t.corner & FIRST_OF_TWO) != 0u;
  EmitterTriangle mate = fetch_emitter_triangle(is_first ? i + 1u : max(i, 1u) - 1u);
  SeenPiece piece = is_first ? see_piece(t, mate, from) : see_piece(mate, t, from);
  if (!piece.is_sampled_as_seen) return by_area;
  return is_first ? seen_density(t, piece.first, piece.first_share)
                  : seen_density(t, piece.second, 1.0 - piece.first_share);
}

/// A direction to one of the emitter triangles [first, first + count). e: their emitter, where
/// there is no light tree. from: the shaded surface; u, v: words, fill: that of u.
EmitterSample area_sample(EmitterRecord e, uint first, uint count, Surface from, uint u, uint v,
                          uint fill) {
  TrianglePoint point = area_point(first, count, from.position, u, v, fill);
  Surface s = surface_at(point.triangle, point.b.x, point.b.y);
  vec3 to = s.position - from.position;
  EmitterSample r;
  r.d = normalize_safe(to);
  r.pdf = point.by_solid_angle ? point.density : area_pdf(point.density, s, r.d, dot3(to, r.d));
  if (LIGHT_TREE) {
    uint emitter = fetch_mesh(s.mesh).emitter;
    e = fetch_emitter(emitter == NONE ? 0u : emitter);
  }
  r.radiance = r.pdf > 0.0 ? area_eval(e, s, r.d) : vec3(0.0);
  // Both ends of the shadow ray are moved off their surfaces; this one must also cover the error of
  // a test from afar.
  r.point = offset_ray_origin(s.position, max(s.magnitude, from.magnitude), s.ng, -r.d);
  r.at_infinity = false;
  r.delta = false;
  return r;
}
