// Textures: colours over (u, v) (docs/reference/sampling.md, "Textures"); manuals in
// host/scene/texture/texture.h.
#ifndef FACET_TEXTURE_GLSL
#define FACET_TEXTURE_GLSL
#include "color.glsl"
#include "parameters.glsl"
#include "records.glsl"
#include "specialization.glsl"

bool is_odd(float whole) { return whole - 2.0 * floor(whole * 0.5) == 1.0; }

// Each axis by itself, since a sum of large numbers rounds.
vec3 checker_value(TextureRecord t, vec2 uv) {
  bool odd_column = is_odd(floor(uv.x * checker_scalex(t)));
  bool odd_row = is_odd(floor(uv.y * checker_scaley(t)));
  return odd_column != odd_row ? checker_odd(t) : checker_even(t);
}

/// What a byte of an image stands for.
float texel_channel(TextureRecord t, uint texel, uint shift) {
  return uintBitsToFloat(fetch_image_word(t.decoding + ((texel >> shift) & 255u)));
}

vec3 image_texel(TextureRecord t, uint x, uint y) {
  uint i = y * t.width + x;
  if ((TEXTURE_KINDS & TEXTURE_FLOATS) != 0u && t.decoding == NONE) {
    uint at = t.first_texel + 3u * i;
    return uintBitsToFloat(
        uvec3(fetch_image_word(at), fetch_image_word(at + 1u), fetch_image_word(at + 2u)));
  }
  uint texel = fetch_image_word(t.first_texel + i);
  return vec3(texel_channel(t, texel, 0u), texel_channel(t, texel, 8u),
              texel_channel(t, texel, 16u));
}

vec3 image_value(TextureRecord t, vec2 uv) {
  vec2 scaled = vec2(uv.x * textmap_scalex(t), uv.y * textmap_scaley(t));
  vec2 within = scaled - floor(scaled);
  vec2 at = vec2((1.0 - within.x) * float(t.width), (1.0 - within.y) * float(t.height));
  vec2 base = floor(at);
  vec2 f = at - base;
  uint w = max(t.width, 1u);
  uint h = max(t.height, 1u);
  uint x0 = uint(base.x) % w;
  uint x1 = (x0 + 1u) % w;
  uint y0 = uint(base.y) % h;
  uint y1 = (y0 + 1u) % h;
  vec3 top = (1.0 - f.x) * image_texel(t, x0, y0) + f.x * image_texel(t, x1, y0);
  vec3 bottom = (1.0 - f.x) * image_texel(t, x0, y1) + f.x * image_texel(t, x1, y1);
  return textmap_color(t) * ((1.0 - f.y) * top + f.y * bottom);
}

/// Value of a texture, or of none.
vec3 texture_value(uint index, vec3 constant, vec2 uv) {
  if (TEXTURE_KINDS == 0u) return constant;
  TextureRecord t = fetch_texture(index == NONE ? 0u : index);
  vec3 value = vec3(0.0);
  if ((TEXTURE_KINDS & TEXTURE_CHECKER) != 0u) value = checker_value(t, uv);
  if ((TEXTURE_KINDS & TEXTURE_IMAGE) != 0u && t.width != 0u) value = image_value(t, uv);
  return index == NONE ? constant : value;
}

/// A BSDF's parameters at a point.
BsdfRecord textured_bsdf(BsdfRecord b, vec2 uv) {
  if (TEXTURE_KINDS == 0u) return b;
  b.a.rgb = texture_value(b.texture_a, b.a.rgb, uv);
  b.b.rgb = texture_value(b.texture_b, b.b.rgb, uv);
  vec3 roughness = texture_value(b.texture_alpha, vec3(0.0), uv);
  float alpha = luminance(roughness.rgb);
  b.a.w = b.texture_alpha == NONE ? b.a.w : min(max(alpha, 1.0e-4), 1.0);
  return b;
}

#endif
