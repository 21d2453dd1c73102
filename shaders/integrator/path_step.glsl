// What shading one interaction of a path leaves to be done.
#ifndef FACET_PATH_STEP_GLSL
#define FACET_PATH_STEP_GLSL
#include "../shared/records.h"

struct PathStep {
  PathRecord path;         // with emission added and throughput updated
  RayRecord next;          // the ray that goes on
  bool alive;              // whether there is such a ray
  ShadowRayRecord shadow;  // a shadow ray; its slot is set by whoever queues it
  bool has_shadow;
};

#endif
