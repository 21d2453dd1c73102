// What the scene has: the constants that fit a kernel to it. The defaults have everything in.
#ifndef FACET_SPECIALIZATION_GLSL
#define FACET_SPECIALIZATION_GLSL
#include "../shared/bindings.h"
#include "../shared/bsdf_list.h"
#include "../shared/emitter_list.h"
#include "../shared/integrator_list.h"

/// Entries of the traversal stack: the tree's own worst case.
layout(constant_id = SPEC_STACK_SIZE) const uint STACK_SIZE = 64;
/// Bit id: the scene has a BSDF or emitter of that id.
layout(constant_id = SPEC_BSDF_MASK) const uint BSDF_MASK = 0xffffffffu;
layout(constant_id = SPEC_EMITTER_MASK) const uint EMITTER_MASK = 0xffffffffu;
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
/// Sums of squares are kept.
layout(constant_id = SPEC_VARIANCE) const bool VARIANCE = true;

// Ids by name: BSDF_diffuse, EMITTER_area, INTEGRATOR_path.
#define FACET_ID(name, Type, id) const uint BSDF_##name = id;
FACET_BSDF_LIST(FACET_ID)
#undef FACET_ID
#define FACET_ID(name, id) const uint EMITTER_##name = id;
FACET_EMITTER_LIST(FACET_ID)
#undef FACET_ID
#define FACET_ID(name, id) const uint INTEGRATOR_##name = id;
FACET_INTEGRATOR_KERNEL_LIST(FACET_ID)
#undef FACET_ID

/// Whether the scene has an emitter of this id.
#define HAS_EMITTER(name) ((EMITTER_MASK & (1u << EMITTER_##name)) != 0u)

#endif
