// Every buffer a kernel can see, from the shared list. A kernel that does not touch one does not
// bind it: unused blocks are compiled away.
#ifndef FACET_BINDINGS_GLSL
#define FACET_BINDINGS_GLSL
#include "../shared/bindings.h"
#include "../shared/records.h"

// What is read as texels of four words has a function NAME_texel(i). The one build variant of the
// kernels is here: texel buffers, read as images (the fast load of lavapipe, inlined, unlike
// texelFetch; a storage buffer it reads word by word, lane by lane), or, where a device's are too
// small, storage buffers.
#ifdef FACET_NO_TEXEL_BUFFERS
#define FACET_DECLARE_scene(number, names, name, Record)                                    \
  layout(std430, binding = number) readonly buffer name##_block { uvec4 name##_texels[]; }; \
  uvec4 name##_texel(uint i) { return name##_texels[i]; }
#define FACET_DECLARE_state(number, names, name, Record) \
  FACET_DECLARE_storage(number, names, name, Record)
#else
#define FACET_DECLARE_scene(number, names, name, Record)                          \
  layout(binding = number, rgba32ui) uniform readonly uimageBuffer name##_texels; \
  uvec4 name##_texel(uint i) { return imageLoad(name##_texels, int(i)); }
#define FACET_DECLARE_state(number, names, name, Record) \
  FACET_DECLARE_storage(number, names, name, Record)     \
      FACET_DECLARE_scene(number + BINDING_TEXELS, names, name, Record)
#endif
#define FACET_DECLARE_uniform(number, names, name, Record) \
  layout(std140, binding = number) uniform names##_block { Record name; };
#define FACET_DECLARE_storage(number, names, name, Record) \
  layout(std430, binding = number) buffer names##_block { Record names[]; };
#define FACET_DECLARE(number, kind, names, name, Record) \
  FACET_DECLARE_##kind(number, names, name, Record)
FACET_BINDING_LIST(FACET_DECLARE)

layout(push_constant) uniform Pass { PassConstants pass_constants; };

#endif
