#version 450
// Finds what the queued rays hit.
#extension GL_GOOGLE_include_directive : require
#include "../lib/queue.glsl"
#include "../lib/records.glsl"
#include "../lib/traversal.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
  uint slot = queued_slot();
  if (slot == NONE) return;
  bool complete;
  hits[slot] = trace_closest(fetch_ray(slot), complete);
  if (!complete) atomicAdd(counters[COUNTER_BOUND_HITS], 1u);
}
