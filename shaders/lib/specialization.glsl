// What the scene has: the constants that fit a kernel to it. The defaults have everything in.
#ifndef FACET_SPECIALIZATION_GLSL
#define FACET_SPECIALIZATION_GLSL
#include "../shared/bindings.h"
#include "../shared/bsdf_list.h"
#include "../shared/emitter_list.h"
#include "../shared/integrator_list.h"
#include "../shared/records.h"
#include "../shared/sampler_list.h"

/// Entries of the traversal stack: the tree's own worst case.
layout(constant_id = SPEC_STACK_SIZE) const uint STACK_SIZE = LARGEST_STACK_SIZE;
/// Bit id: the scene has a BSDF or emitter of that id.
layout(constant_id = SPEC_BSDF_MASK) const uint BSDF_MASK = 0xffffffffu;
layout(constant_id = SPEC_EMITTER_MASK) const uint EMITTER_MASK = 0xffffffffu;
/// There is more than one emitter.
layout(constant_id = SPEC_SEVERAL_EMITTERS) const bool SEVERAL_EMITTERS = true;
/// Bit 0: some emitter's triangles are sampled by themselves; bit 1: some are, two as one.
layout(constant_id = SPEC_EMITTER_PIECES) const uint EMITTER_PIECES = 3;
/// Emitters and their triangles are chosen by a light tree.
layout(constant_id = SPEC_LIGHT_TREE) const bool LIGHT_TREE = true;
/// Points of area emitters are sampled by solid angle.
layout(constant_id = SPEC_SOLID_ANGLE) const bool SOLID_ANGLE = false;
/// Some mesh has vertex normals.
layout(constant_id = SPEC_SHADING_NORMALS) const bool SHADING_NORMALS = true;
/// Shading kernel, id of FACET_INTEGRATOR_KERNEL_LIST.
layout(constant_id = SPEC_INTEGRATOR) const uint INTEGRATOR = 3;
/// Direct light is estimated by sampling emitters; by sampling BSDFs; by both, weighted.
layout(constant_id = SPEC_EMITTER_SAMPLING) const bool EMITTER_SAMPLING = true;
layout(constant_id = SPEC_MATERIAL_SAMPLING) const bool MATERIAL_SAMPLING = true;
/// Half vectors from the visible normals (else from the NDF).
layout(constant_id = SPEC_VISIBLE_NORMALS) const bool VISIBLE_NORMALS = true;
/// MIS by the power heuristic, beta = 2 (else balance).
layout(constant_id = SPEC_POWER_HEURISTIC) const bool POWER_HEURISTIC = false;
/// Paths can be long enough for Russian roulette.
layout(constant_id = SPEC_ROULETTE) const bool ROULETTE = true;
/// Flags that some BSDF of the scene has, and those that all have that could (of rough ones: the
/// rough ones).
layout(constant_id = SPEC_BSDF_FLAGS_SOME) const uint BSDF_FLAGS_SOME = 0xffffffffu;
layout(constant_id = SPEC_BSDF_FLAGS_ALL) const uint BSDF_FLAGS_ALL = 0;
/// Bit 0: the scene has a checker; bit 1: a textmap.
layout(constant_id = SPEC_TEXTURE_KINDS) const uint TEXTURE_KINDS = 7;
/// Every emitter is sampled at each interaction, and paths go on at delta lobes alone.
layout(constant_id = SPEC_EVERY_EMITTER) const bool EVERY_EMITTER = false;
/// Where random numbers come from, id of FACET_SAMPLER_LIST.
layout(constant_id = SPEC_SAMPLER) const uint SAMPLER = 0;
/// The reconstruction filter is negative in parts.
layout(constant_id = SPEC_NEGATIVE_FILTER) const bool NEGATIVE_FILTER = true;
/// The bounce is that of the camera's rays; it comes after the last interaction, so that emission
/// alone is looked for.
layout(constant_id = SPEC_CAMERA_BOUNCE) const bool CAMERA_BOUNCE = true;
layout(constant_id = SPEC_LAST_BOUNCE) const bool LAST_BOUNCE = false;
/// Emitter samples of which one is taken, by what it would contribute unshadowed.
layout(constant_id = SPEC_CANDIDATES) const uint CANDIDATES = 1;
/// No bounce follows the first.
layout(constant_id = SPEC_ONLY_BOUNCE) const bool ONLY_BOUNCE = false;
/// The pixels of a pass are those of a list.
layout(constant_id = SPEC_PIXEL_LIST) const bool PIXEL_LIST = true;
/// Sums of squares are kept.
layout(constant_id = SPEC_VARIANCE) const bool VARIANCE = true;

// Ids by name: BSDF_diffuse, EMITTER_area, INTEGRATOR_path, SAMPLER_sobol.
#define FACET_ID(name, Type, id) const uint BSDF_##name = id;
FACET_BSDF_LIST(FACET_ID)
#undef FACET_ID
#define FACET_ID(name, id) const uint EMITTER_##name = id;
FACET_EMITTER_LIST(FACET_ID)
#undef FACET_ID
#define FACET_ID(name, id) const uint INTEGRATOR_##name = id;
FACET_INTEGRATOR_KERNEL_LIST(FACET_ID)
#undef FACET_ID
#define FACET_ID(name, id) const uint SAMPLER_##name = id;
FACET_SAMPLER_LIST(FACET_ID)
#undef FACET_ID

/// Whether the scene has an emitter of this id.
#define HAS_EMITTER(name) ((EMITTER_MASK & (1u << EMITTER_##name)) != 0u)
/// True for an emitter's type of this id; known when the kernel is specialised where the scene has
/// none of it, or nothing else.
#define IS_EMITTER(type, name) \
  (HAS_EMITTER(name) && (EMITTER_MASK == (1u << EMITTER_##name) || type == EMITTER_##name))
/// Whether the BSDF has the flag; known when the kernel is specialised where none has it, or all.
#define HAS_FLAG(bsdf_flags, flag) \
  ((BSDF_FLAGS_SOME & flag) != 0u && ((BSDF_FLAGS_ALL & flag) != 0u || (bsdf_flags & flag) != 0u))

#endif
