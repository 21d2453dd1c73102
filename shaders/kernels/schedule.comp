#version 450
// Between two bounces: turns the queues' lengths into the sizes of the next dispatches and
// keeps count of the rays.
#extension GL_GOOGLE_include_directive : require
#include "../lib/bindings.glsl"

layout(local_size_x = 1) in;

void write_indirect(uint at, uint count) {
  counters[at] = (count + WORKGROUP_SIZE - 1u) / WORKGROUP_SIZE;
  counters[at + 1u] = 1u;
  counters[at + 2u] = 1u;
}

void main() {
  uint now = pass_constants.queue;
  if (pass_constants.stage == 0u) {
    // Before extend and shade: the paths of this bounce.
    write_indirect(INDIRECT_PATHS, counters[COUNTER_ACTIVE + now]);
    counters[COUNTER_CLOSEST_RAYS] += counters[COUNTER_ACTIVE + now];
    counters[COUNTER_ACTIVE + 1u - now] = 0u;
    counters[COUNTER_SHADOW] = 0u;
  } else if (pass_constants.stage == 2u) {
    counters[COUNTER_SHADOW] = 0u;
  } else {
    write_indirect(INDIRECT_SHADOW, counters[COUNTER_SHADOW]);
    counters[COUNTER_ANY_RAYS] += counters[COUNTER_SHADOW];
  }
}
