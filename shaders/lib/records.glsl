// Reads of whole records.
#ifndef FACET_RECORDS_GLSL
#define FACET_RECORDS_GLSL
#include "bindings.glsl"
#include "vector.glsl"

// The state of paths and the film are written as storage and read as texels, where texel buffers are large enough. (Written as texels it was
// slower.) The two are one memory, so a kernel reads a record before it writes it, and never after.
#ifdef FACET_NO_TEXEL_BUFFERS
RayRecord fetch_ray(uint i) { return rays[i]; }
HitRecord fetch_hit(uint i) { return hits[i]; }
PathRecord fetch_path(uint i) { return paths[i]; }
vec3 fetch_radiance(uint i) { return paths[i].radiance.rgb; }
FilmRecord fetch_film(uint i) { return film[i]; }
FilmRecord fetch_film_squares(uint i) { return film_squares[i]; }
#else
FACET_TEXELS(BINDING_RAY_TEXELS, ray)
FACET_TEXELS(BINDING_HIT_TEXELS, hit)
FACET_TEXELS(BINDING_PATH_TEXELS, path)
FACET_TEXELS(BINDING_FILM_TEXELS, film)
FACET_TEXELS(BINDING_FILM_SQUARES_TEXELS, film_squares)

RayRecord fetch_ray(uint i) { return RayRecord(uintBitsToFloat(ray_texel(2u * i)), uintBitsToFloat(ray_texel(2u * i + 1u))); }

HitRecord fetch_hit(uint i) {
  uvec4 t = hit_texel(i);
  return HitRecord(uintBitsToFloat(t.x), t.y, uintBitsToFloat(t.z), uintBitsToFloat(t.w));
}

PathRecord fetch_path(uint i) {
  return PathRecord(uintBitsToFloat(path_texel(2u * i)), uintBitsToFloat(path_texel(2u * i + 1u)));
}

/// A path's alone.
vec3 fetch_radiance(uint i) { return uintBitsToFloat(path_texel(2u * i + 1u).rgb); }

FilmRecord film_record(uvec4 high, uvec4 low) {
  vec3 h = uintBitsToFloat(high.rgb);
  vec3 l = uintBitsToFloat(low.rgb);
  return FilmRecord(h.r, h.g, h.b, high.w, l.r, l.g, l.b, low.w);
}

FilmRecord fetch_film(uint i) { return film_record(film_texel(2u * i), film_texel(2u * i + 1u)); }
FilmRecord fetch_film_squares(uint i) { return film_record(film_squares_texel(2u * i), film_squares_texel(2u * i + 1u)); }
#endif

MeshRecord fetch_mesh(uint i) {
  uvec4 t = mesh_texel(i);
  return MeshRecord(t.x, t.y, t.z, t.w);
}

BsdfRecord fetch_bsdf(uint i) {
  uvec4 s = bsdf_texel(5u * i);
  uvec4 t = bsdf_texel(5u * i + 1u);
  return BsdfRecord(s.x, s.y, s.z, s.w, t.x, t.y, t.z, t.w, uintBitsToFloat(bsdf_texel(5u * i + 2u)),
                    uintBitsToFloat(bsdf_texel(5u * i + 3u)), uintBitsToFloat(bsdf_texel(5u * i + 4u)));
}

EmitterRecord fetch_emitter(uint i) {
  uvec4 s = emitter_texel(4u * i + 2u);
  uvec4 t = emitter_texel(4u * i + 3u);
  return EmitterRecord(uintBitsToFloat(emitter_texel(4u * i)), uintBitsToFloat(emitter_texel(4u * i + 1u)), s.x, s.y, s.z, s.w,
                       uintBitsToFloat(t.x), t.y, t.z, t.w);
}

/// What the emitter is chosen by (EmitterRecord::cumulative).
uint fetch_emitter_cumulative(uint i) { return emitter_texel(4u * i + 2u).y; }

EmitterTriangle fetch_emitter_triangle(uint i) {
  uvec4 t = emitter_triangles_texel(i);
  return EmitterTriangle(t.x, t.y, uintBitsToFloat(t.z), t.w);
}

EnvironmentRow fetch_environment_row(uint i) {
  uvec4 t = environment_row_texel(i);
  return EnvironmentRow(t.x, uintBitsToFloat(t.y), uintBitsToFloat(t.z), t.w);
}

uint fetch_environment_column(uint i) { return word_of(environment_columns_texel(i / 4u), i % 4u); }

/// A vertex' texture coordinates.
vec2 fetch_texcoord(uint i) {
  vec4 two = uintBitsToFloat(texcoords_texel(i / 2u));
  return i % 2u == 0u ? two.xy : two.zw;
}

TextureRecord fetch_texture(uint i) {
  uvec4 t = texture_texel(3u * i + 2u);
  return TextureRecord(uintBitsToFloat(texture_texel(3u * i)), uintBitsToFloat(texture_texel(3u * i + 1u)), t.x, t.y, t.z, t.w);
}

/// A texel of an image, or what its bytes stand for.
uint fetch_image_word(uint i) { return word_of(image_texel(i / 4u), i % 4u); }

float fetch_albedo(uint i) { return uintBitsToFloat(word_of(albedos_texel(i / 4u), i % 4u)); }

#endif
