// What shading one interaction of a path leaves to be done.
#ifndef FACET_PATH_STEP_GLSL
#define FACET_PATH_STEP_GLSL
#include "../shared/records.h"

struct PathStep {
  PathRecord path;    // with emission added and throughput updated
  RayRecord next;     // the ray that goes on
  bool alive;         // whether there is such a ray
  RayRecord shadow;   // a shadow ray
  vec3 contribution;  // of what arrives along it if it meets nothing, W sr^-1 m^-2
  bool has_shadow;
};

/// A path that ends as it is.
PathStep unchanged_path(PathRecord path, RayRecord ray) {
  return PathStep(path, ray, false, ray, vec3(0.0), false);
}

#endif
