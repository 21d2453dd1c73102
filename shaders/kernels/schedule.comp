#version 450
// Before a bounce: turns the queue's length into the size of the bounce's dispatch, empties the
// other queue, and keeps count of the rays.
#extension GL_GOOGLE_include_directive : require
#include "../lib/bindings.glsl"

layout(local_size_x = 1) in;

void main() {
  uint now = pass_constants.queue;
  uint paths_queued = counters[COUNTER_ACTIVE + now];
  counters[INDIRECT_PATHS] = (paths_queued + WORKGROUP_SIZE - 1u) / WORKGROUP_SIZE;
  counters[INDIRECT_PATHS + 1u] = 1u;
  counters[INDIRECT_PATHS + 2u] = 1u;
  counters[COUNTER_CLOSEST_RAYS] += paths_queued;
  counters[COUNTER_ACTIVE + 1u - now] = 0u;
}
