// Reads of whole records: fetch_NAME(i) for every binding of kind scene or state. What a kernel
// does not use of a record is not read.
#ifndef FACET_RECORDS_GLSL
#define FACET_RECORDS_GLSL
#include "bindings.glsl"
#include "vector.glsl"
#include "record_reads.glsl"

#endif
