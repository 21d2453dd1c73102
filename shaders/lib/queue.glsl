// Queues of slots. Their order depends on timing; no result does, since a slot touches only its own
// records.
#ifndef FACET_QUEUE_GLSL
#define FACET_QUEUE_GLSL
#include "bindings.glsl"

/// Slots in flight at most: the size of each half of the queues.
uint queue_capacity() { return uint(queues.length()) / 2u; }

/// Entry i of this bounce's queue, NONE beyond its end.
uint queued_slot(uint i) {
  return i < counters[COUNTER_ACTIVE + pass_constants.queue]
             ? queues[pass_constants.queue * queue_capacity() + i]
             : NONE;
}

/// Puts a slot into the queue of the next bounce.
void push_path(uint slot) {
  uint other = 1u - pass_constants.queue;
  uint i = atomicAdd(counters[COUNTER_ACTIVE + other], 1u);
  queues[other * queue_capacity() + i] = slot;
}

#endif
