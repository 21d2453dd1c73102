// What the kernels that evaluate one BSDF alone read and write.
#ifndef FACET_EVALUATION_GLSL
#define FACET_EVALUATION_GLSL
#include "bindings.glsl"

layout(std430, binding = BINDING_EVALUATION) readonly buffer Evaluation { EvaluationRecord evaluation; };
layout(std430, binding = BINDING_QUERIES) readonly buffer Queries { QueryRecord queries[]; };
/// Value f in rgb, or a sample's direction; w: density, sr^-1.
layout(std430, binding = BINDING_VALUES) writeonly buffer Values { vec4 values[]; };
/// Weights of samples in rgb.
layout(std430, binding = BINDING_WEIGHTS) writeonly buffer Weights { vec4 weights[]; };

#endif
