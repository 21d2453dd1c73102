// Reads of whole records. As texels where texel buffers are large enough: lavapipe reads a storage buffer word by word, lane by
// lane, which took more than half of the time of shading. Writes go to the storage buffers (as texels they were slower): the two
// are one memory, so a kernel reads a record before it writes it, and never after.
#ifndef FACET_RECORDS_GLSL
#define FACET_RECORDS_GLSL
#include "bindings.glsl"

#ifdef FACET_NO_TEXEL_BUFFERS
RayRecord fetch_ray(uint i) { return rays[i]; }
HitRecord fetch_hit(uint i) { return hits[i]; }
PathRecord fetch_path(uint i) { return paths[i]; }
ShadowRayRecord fetch_shadow_ray(uint i) { return shadow_rays[i]; }
MeshRecord fetch_mesh(uint i) { return meshes[i]; }
BsdfRecord fetch_bsdf(uint i) { return bsdfs[i]; }
EmitterRecord fetch_emitter(uint i) { return emitters[i]; }
#else
layout(binding = BINDING_RAY_TEXELS, rgba32ui) uniform readonly uimageBuffer ray_texels;
layout(binding = BINDING_HIT_TEXELS, rgba32ui) uniform readonly uimageBuffer hit_texels;
layout(binding = BINDING_PATH_TEXELS, rgba32ui) uniform readonly uimageBuffer path_texels;
layout(binding = BINDING_SHADOW_RAY_TEXELS, rgba32ui) uniform readonly uimageBuffer shadow_ray_texels;
layout(binding = BINDING_MESH_TEXELS, rgba32ui) uniform readonly uimageBuffer mesh_texels;
layout(binding = BINDING_BSDF_TEXELS, rgba32ui) uniform readonly uimageBuffer bsdf_texels;
layout(binding = BINDING_EMITTER_TEXELS, rgba32ui) uniform readonly uimageBuffer emitter_texels;

RayRecord fetch_ray(uint i) {
  int at = int(2u * i);
  return RayRecord(uintBitsToFloat(imageLoad(ray_texels, at)), uintBitsToFloat(imageLoad(ray_texels, at + 1)));
}

HitRecord fetch_hit(uint i) {
  uvec4 t = imageLoad(hit_texels, int(i));
  return HitRecord(uintBitsToFloat(t.x), t.y, uintBitsToFloat(t.z), uintBitsToFloat(t.w));
}

PathRecord fetch_path(uint i) {
  int at = int(2u * i);
  return PathRecord(uintBitsToFloat(imageLoad(path_texels, at)), uintBitsToFloat(imageLoad(path_texels, at + 1)));
}

ShadowRayRecord fetch_shadow_ray(uint i) {
  int at = int(3u * i);
  uvec4 last = imageLoad(shadow_ray_texels, at + 2);
  vec3 contribution = uintBitsToFloat(last.xyz);
  return ShadowRayRecord(uintBitsToFloat(imageLoad(shadow_ray_texels, at)), uintBitsToFloat(imageLoad(shadow_ray_texels, at + 1)),
                         contribution.r, contribution.g, contribution.b, last.w);
}

MeshRecord fetch_mesh(uint i) {
  uvec4 t = imageLoad(mesh_texels, int(i));
  return MeshRecord(t.x, t.y, t.z, t.w);
}

BsdfRecord fetch_bsdf(uint i) {
  int at = int(4u * i);
  uvec4 s = imageLoad(bsdf_texels, at);
  uvec4 t = imageLoad(bsdf_texels, at + 1);
  return BsdfRecord(s.x, s.y, s.z, s.w, t.x, t.y, t.z, t.w, uintBitsToFloat(imageLoad(bsdf_texels, at + 2)),
                    uintBitsToFloat(imageLoad(bsdf_texels, at + 3)));
}

EmitterRecord fetch_emitter(uint i) {
  int at = int(4u * i);
  uvec4 s = imageLoad(emitter_texels, at + 2);
  uvec4 t = imageLoad(emitter_texels, at + 3);
  return EmitterRecord(uintBitsToFloat(imageLoad(emitter_texels, at)), uintBitsToFloat(imageLoad(emitter_texels, at + 1)), s.x,
                       s.y, s.z, s.w, uintBitsToFloat(t.x), t.y, t.z, t.w);
}
#endif

#endif
