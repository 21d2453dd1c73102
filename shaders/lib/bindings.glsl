// Every buffer a kernel can see. A kernel that does not touch one does not bind it: unused blocks are compiled away.
#ifndef FACET_BINDINGS_GLSL
#define FACET_BINDINGS_GLSL
#include "../shared/bindings.h"
#include "../shared/records.h"

// The scene, in texels of four words, each array with a function NAME_texel(i). The one build variant of the kernels is here:
// texel buffers, read as images (the fast load of lavapipe, inlined, unlike texelFetch; a storage buffer it reads word by word,
// lane by lane), or, where a device's are too small, storage buffers.
#ifdef FACET_NO_TEXEL_BUFFERS
#define FACET_TEXELS(number, name)                                                          \
  layout(std430, binding = number) readonly buffer name##_buffer { uvec4 name##_texels[]; }; \
  uvec4 name##_texel(uint i) { return name##_texels[i]; }
#else
#define FACET_TEXELS(number, name)                                            \
  layout(binding = number, rgba32ui) uniform readonly uimageBuffer name##_texels; \
  uvec4 name##_texel(uint i) { return imageLoad(name##_texels, int(i)); }
#endif
FACET_TEXELS(BINDING_BVH, bvh)
FACET_TEXELS(BINDING_PAIRS, pair)
FACET_TEXELS(BINDING_NORMAL_INDICES, normal_indices)
FACET_TEXELS(BINDING_NORMALS, normal)
FACET_TEXELS(BINDING_MESHES, mesh)
FACET_TEXELS(BINDING_BSDFS, bsdf)
FACET_TEXELS(BINDING_EMITTERS, emitter)
FACET_TEXELS(BINDING_EMITTER_TRIANGLES, emitter_triangles)
FACET_TEXELS(BINDING_ENVIRONMENT_TEXELS, environment_map)
FACET_TEXELS(BINDING_ENVIRONMENT_ROWS, environment_row)
FACET_TEXELS(BINDING_ENVIRONMENT_COLUMNS, environment_columns)
FACET_TEXELS(BINDING_FILTER, filter)
FACET_TEXELS(BINDING_TEXCOORD_INDICES, texcoord_indices)
FACET_TEXELS(BINDING_TEXCOORDS, texcoords)
FACET_TEXELS(BINDING_TEXTURES, texture)
FACET_TEXELS(BINDING_TEXELS, image)
FACET_TEXELS(BINDING_ALBEDOS, albedos)

// A uniform buffer: the one kind that lavapipe reads once for all lanes.
layout(std140, binding = BINDING_FRAME) uniform FrameBuffer { FrameRecord frame; };
layout(std430, binding = BINDING_RAYS) buffer Rays { RayRecord rays[]; };
layout(std430, binding = BINDING_HITS) buffer Hits { HitRecord hits[]; };
layout(std430, binding = BINDING_PATHS) buffer Paths { PathRecord paths[]; };
layout(std430, binding = BINDING_QUEUES) buffer Queues { uint queues[]; };
layout(std430, binding = BINDING_COUNTERS) buffer Counters { uint counters[]; };
layout(std430, binding = BINDING_FILM) buffer Film { FilmRecord film[]; };
layout(std430, binding = BINDING_FILM_SQUARES) buffer FilmSquares { FilmRecord film_squares[]; };

layout(push_constant) uniform Pass { PassConstants pass_constants; };

#endif
