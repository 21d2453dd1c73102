// A triangle as it is seen from a point, and its points uniformly by solid angle.
// Sources: J. Arvo, "Stratified Sampling of Spherical Triangles", SIGGRAPH 1995; A. van Oosterom,
// J. Strackee, "The Solid Angle of a Plane Triangle", IEEE Trans. Biomed. Eng. 30(2), 1983.
#ifndef FACET_SEEN_TRIANGLE_GLSL
#define FACET_SEEN_TRIANGLE_GLSL
#include "elementary.glsl"
#include "triangle.glsl"

struct SeenTriangle {
  vec3 a;  // unit directions to the vertices, in order of reading
  vec3 b;
  vec3 c;
  vec3 distances;     // of the vertices
  float volume;       // |a . (b x c)|
  float area;         // of the triangle itself
  float solid_angle;  // sr; NaN from a vertex
};

SeenTriangle see_corners(vec3 v0, vec3 v1, vec3 v2, vec3 from) {
  SeenTriangle t;
  vec3 to0 = v0 - from;
  vec3 to1 = v1 - from;
  vec3 to2 = v2 - from;
  t.distances = vec3(sqrt(dot3(to0, to0)), sqrt(dot3(to1, to1)), sqrt(dot3(to2, to2)));
  t.a = to0 / t.distances.x;
  t.b = to1 / t.distances.y;
  t.c = to2 / t.distances.z;
  // Squares of lengths are all that has to be within a float's range.
  vec3 e = v1 - v0;
  float length_of_e = sqrt(dot3(e, e));
  vec3 across = cross3(e / length_of_e, v2 - v0);
  t.area = 0.5 * (length_of_e * sqrt(dot3(across, across)));
  // By the distance from the plane: the product of the directions has few digits of a small
  // triangle.
  float height = abs(dot3(triangle_normal(v0, v1, v2), t.a));
  t.volume = height * (2.0 * t.area / (t.distances.y * t.distances.z));
  float sum = 1.0 + dot3(t.a, t.b) + dot3(t.b, t.c) + dot3(t.c, t.a);
  t.solid_angle = 2.0 * atan2_accurate(t.volume, sum);
  return t;
}

/// Barycentric weights of the second and third vertex of the point (u, v): u is the share of the
/// solid angle that lies between the edge ab and the arc from b through the point, v decides where
/// on that arc.
vec2 seen_point(SeenTriangle t, vec2 u) {
  float ab = dot3(t.a, t.b);
  float ca = dot3(t.c, t.a);
  // sin and cos of half the part's solid angle.
  vec2 half_part = sincos_turns(u.x * t.solid_angle * 0.0795774715);
  // tan of half the way from a along the edge ac: x/y.
  vec3 across = cross3(t.a, t.c);
  float sin_ca = sqrt(dot3(across, across));
  float x = (1.0 + ab) * half_part.x * sin_ca;
  // The last product is b . c - (a . b) (a . c), whose digits cancel where the triangle looks
  // small.
  float y = t.volume * half_part.y - dot3(cross3(t.a, t.b), across) * half_part.x;
  float size = sin_ca * (x * x + y * y);
  float of_a = max(sin_ca * (y * y - x * x) - 2.0 * ca * x * y, 0.0) / size;
  float of_c = 2.0 * x * y / size;
  // The end of the arc from b, and 1 less the cosine of the arc's angle.
  vec3 apart = of_a * t.a + of_c * t.c - t.b;
  float arc = 0.5 * dot3(apart, apart);
  float of_end = sqrt(u.y * ((2.0 - u.y * arc) / (2.0 - arc)));
  float of_b = max((1.0 - u.y * arc) - (1.0 - arc) * of_end, 0.0);
  vec3 weights = vec3(of_end * of_a, of_b, of_end * of_c) / t.distances;
  float sum = weights.x + weights.y + weights.z;
  return sum > 0.0 ? weights.yz / sum : vec2(0.0);
}

#endif
