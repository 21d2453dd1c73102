// Every buffer a kernel can see. A kernel that does not touch one does not bind it: unused blocks are compiled away.
#ifndef FACET_BINDINGS_GLSL
#define FACET_BINDINGS_GLSL
#include "../shared/bindings.h"
#include "../shared/records.h"

layout(std430, binding = BINDING_NORMAL_INDICES) readonly buffer NormalIndices { uvec4 normal_indices[]; };
layout(std430, binding = BINDING_NORMALS) readonly buffer Normals { float normals[]; };
layout(std430, binding = BINDING_MESHES) readonly buffer Meshes { MeshRecord meshes[]; };
layout(std430, binding = BINDING_BSDFS) readonly buffer Bsdfs { BsdfRecord bsdfs[]; };
layout(std430, binding = BINDING_EMITTERS) readonly buffer Emitters { EmitterRecord emitters[]; };
layout(std430, binding = BINDING_EMITTER_TRIANGLES) readonly buffer EmitterTriangles {
  EmitterTriangle emitter_triangles[];
};
layout(std430, binding = BINDING_ENVIRONMENT_TEXELS) readonly buffer EnvironmentTexels { vec4 environment_texels[]; };
layout(std430, binding = BINDING_ENVIRONMENT_ROWS) readonly buffer EnvironmentRows {
  EnvironmentRow environment_rows[];
};
layout(std430, binding = BINDING_ENVIRONMENT_COLUMNS) readonly buffer EnvironmentColumns { uint environment_columns[]; };
layout(std430, binding = BINDING_FILTER) readonly buffer Filter { vec2 filter_quantiles[]; };
layout(std430, binding = BINDING_TEXCOORD_INDICES) readonly buffer TexcoordIndices { uvec4 texcoord_indices[]; };
layout(std430, binding = BINDING_TEXCOORDS) readonly buffer Texcoords { vec2 texcoords[]; };
layout(std430, binding = BINDING_TEXTURES) readonly buffer Textures { TextureRecord textures[]; };
layout(std430, binding = BINDING_TEXELS) readonly buffer Texels { uint texels[]; };
layout(std430, binding = BINDING_ALBEDOS) readonly buffer Albedos { float albedos[]; };
// A uniform buffer: the one kind that lavapipe reads once for all lanes.
layout(std140, binding = BINDING_FRAME) uniform FrameBuffer { FrameRecord frame; };
layout(std430, binding = BINDING_RAYS) buffer Rays { RayRecord rays[]; };
layout(std430, binding = BINDING_HITS) buffer Hits { HitRecord hits[]; };
layout(std430, binding = BINDING_PATHS) buffer Paths { PathRecord paths[]; };
layout(std430, binding = BINDING_SHADOW_RAYS) buffer ShadowRays { ShadowRayRecord shadow_rays[]; };
layout(std430, binding = BINDING_QUEUES) buffer Queues { uint queues[]; };
layout(std430, binding = BINDING_COUNTERS) buffer Counters { uint counters[]; };
layout(std430, binding = BINDING_FILM) buffer Film { FilmRecord film[]; };
layout(std430, binding = BINDING_FILM_SQUARES) buffer FilmSquares { FilmRecord film_squares[]; };

layout(push_constant) uniform Pass { PassConstants pass_constants; };

#endif
