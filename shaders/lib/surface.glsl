// What a hit means: position, normals, material.
#ifndef FACET_SURFACE_GLSL
#define FACET_SURFACE_GLSL
#include "bindings.glsl"
#include "geometry.glsl"
#include "records.glsl"
#include "specialization.glsl"

struct Surface {
  vec3 position;    // world space
  float magnitude;  // largest absolute coordinate of the triangle's vertices: scales the bound of
                    // rounding errors
  vec3 ng;          // geometric normal, unit, by the triangle's winding
  vec3 ns;          // shading normal, unit: interpolated where the mesh has vertex normals
  vec2 uv;          // texture coordinates, where the scene has textures
  uint mesh;
  uint index;  // of the triangle in the scene, in order of reading
};

/// The point of a triangle with barycentric weights b1 and b2 of its second and third vertex in
/// order of reading.
Surface surface_at(uint triangle, float b1, float b2) {
  TriangleName name = triangle_name(triangle);
  Vertices v = fetch_vertices(triangle, name.corners);
  float b0 = (1.0 - b1) - b2;
  Surface s;
  s.position = (b0 * v.v0 + b1 * v.v1) + b2 * v.v2;
  vec3 largest = max(abs(v.v0), max(abs(v.v1), abs(v.v2)));
  s.magnitude = max(largest.x, max(largest.y, largest.z));
  s.ng = triangle_normal(v.v0, v.v1, v.v2);
  s.ns = s.ng;
  s.mesh = name.mesh;
  s.index = name.index;
  uint attributes = SHADING_NORMALS || TEXTURE_KINDS != 0u ? fetch_mesh(s.mesh).attributes : NONE;
  bool listed = attributes != NONE;
  uint index = listed ? name.index - attributes : 0u;
  if (SHADING_NORMALS) {
    uvec4 n = fetch_normal_indices(index);
    bool has = listed && n.x != NONE;
    n = has ? n : uvec4(0u);
    vec3 interpolated = normalize_safe((b0 * fetch_normal(n.x).xyz + b1 * fetch_normal(n.y).xyz) +
                                       b2 * fetch_normal(n.z).xyz);
    s.ns = (has && interpolated != vec3(0.0)) ? interpolated : s.ng;
  }
  s.uv = vec2(b1, b2);
  if (TEXTURE_KINDS != 0u) {
    uvec4 t = fetch_texcoord_indices(index);
    bool has = listed && t.x != NONE;
    t = has ? t : uvec4(0u);
    vec2 interpolated =
        (b0 * fetch_texcoord(t.x) + b1 * fetch_texcoord(t.y)) + b2 * fetch_texcoord(t.z);
    s.uv = has ? interpolated : s.uv;
  }
  return s;
}

#endif
