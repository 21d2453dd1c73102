// Every integrator, once: X(name, kernel, emitter sampling, material sampling, interactions).
// `kernel` names the shading function in shaders/integrator; the two flags say which estimators of
// direct light it uses (both: combined by MIS), emitter sampling 2 being a sample of every emitter,
// where paths go on at delta lobes alone; `interactions` is the number of surface interactions it
// is limited to, -1 where the scene's maxDepth alone limits it. `name` is the scene language's
// type.
#ifndef FACET_SHARED_INTEGRATOR_LIST_H
#define FACET_SHARED_INTEGRATOR_LIST_H
#include "types.h"
FACET_SHARED_BEGIN

/// First interaction at which the path kernel plays Russian roulette (docs/reference/sampling.md).
FACET_CONSTANT uint ROULETTE_FIRST = 4u;

/// Most candidates of an emitter sample.
FACET_CONSTANT uint LARGEST_CANDIDATES = 16u;

FACET_SHARED_END

#define FACET_INTEGRATOR_LIST(X)    \
  X(normals, normals, 0, 0, 1)      \
  X(depth, depth, 0, 0, 1)          \
  X(ao, ambient_occlusion, 0, 0, 1) \
  X(simple, simple, 0, 0, 1)        \
  X(whitted, path, 2, 0, -1)        \
  X(direct_whitted, path, 2, 0, 1)  \
  X(direct_ems, path, 1, 0, 1)      \
  X(direct_mats, path, 0, 1, 1)     \
  X(direct_mis, path, 1, 1, 1)      \
  X(path, path, 1, 1, -1)           \
  X(path_mats, path, 0, 1, -1)      \
  X(path_ems, path, 1, 0, -1)       \
  X(path_nee, path, 1, 0, -1)       \
  X(path_mis, path, 1, 1, -1)

/// Every shading kernel, once: X(name, id).
#define FACET_INTEGRATOR_KERNEL_LIST(X) \
  X(normals, 0)                         \
  X(depth, 1)                           \
  X(ambient_occlusion, 2)               \
  X(path, 3)                            \
  X(simple, 4)

#endif
