#version 450
// The arithmetic that facet builds on, of numbers at the edges of float: what `facet extremes`
// checks first on a device.
#extension GL_GOOGLE_include_directive : require
#include "../shared/bindings.h"
#include "../shared/extreme_inputs.h"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(constant_id = 0) const uint OPERATION = 0u;
layout(push_constant) uniform Range {
  uint first;
  uint stride;
  uint count;
}
range;
layout(std430, binding = 0) writeonly buffer Results { uint results[]; };

uint flag(bool condition, uint bit) { return condition ? 1u << bit : 0u; }

uint of_word(uint word) {
  float x = uintBitsToFloat(word);
  float y = x;
  if (OPERATION == ARITHMETIC_NEGATION) y = -x;
  if (OPERATION == ARITHMETIC_ABS) y = abs(x);
  if (OPERATION == ARITHMETIC_FLOOR) y = floor(x);
  if (OPERATION == ARITHMETIC_SQRT) y = sqrt(x);
  if (OPERATION == ARITHMETIC_OF_UINT) y = float(word);
  if (OPERATION == ARITHMETIC_OF_INT) y = float(int(word));
  if (OPERATION == ARITHMETIC_TO_UINT) return uint(x);
  if (OPERATION == ARITHMETIC_TO_INT) return uint(int(x));
  if (OPERATION == ARITHMETIC_KINDS)
    return flag(x != x, 0u) | flag(abs(x) <= 3.40282347e38, 1u) | flag(x == 0.0, 2u) |
           flag(x < 0.0, 3u);
  return floatBitsToUint(y);
}

uint of_numbers(float a, float b, float c) {
  if (OPERATION == ARITHMETIC_ORDER)
    return flag(a < b, 0u) | flag(a <= b, 1u) | flag(a == b, 2u) | flag(a != b, 3u) |
           flag(a >= b, 4u) | flag(a > b, 5u);
  float y = a + b;
  if (OPERATION == ARITHMETIC_DIFFERENCE) y = a - b;
  if (OPERATION == ARITHMETIC_PRODUCT) y = a * b;
  if (OPERATION == ARITHMETIC_QUOTIENT) y = a / b;
  if (OPERATION == ARITHMETIC_MIN) y = min(a, b);
  if (OPERATION == ARITHMETIC_MAX) y = max(a, b);
  if (OPERATION == ARITHMETIC_PRODUCT_AND_SUM) y = a * b + c;
  if (OPERATION == ARITHMETIC_SUM_OF_PRODUCTS) y = a * b + a * c;
  if (OPERATION == ARITHMETIC_SUMS_OF_CONSTANTS) y = (a + 0.1) + 0.7;
  if (OPERATION == ARITHMETIC_PRODUCTS_OF_CONSTANTS) y = (a * 1.1) * 1.3;
  if (OPERATION == ARITHMETIC_THIRD) y = a / 3.0;
  return floatBitsToUint(y);
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= range.count) return;
  uint index = range.first + i * range.stride;
  if (OPERATION < ARITHMETIC_SUM) {
    results[i] = of_word(index);
  } else {
    vec3 numbers = uintBitsToFloat(edge_numbers(index).xyz);
    results[i] = of_numbers(numbers.x, numbers.y, numbers.z);
  }
}
