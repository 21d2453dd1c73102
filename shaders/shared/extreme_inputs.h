// Inputs at the edges of float, made of an index alike on the host and in kernels, and the numbers
// of what kernels/arithmetic.comp and kernels/functions.comp compute of them (`facet extremes`).
#ifndef FACET_SHARED_EXTREME_INPUTS_H
#define FACET_SHARED_EXTREME_INPUTS_H
#include "random_hash.h"
#ifdef __cplusplus
#include <glm/common.hpp>
#endif
FACET_SHARED_BEGIN
#ifdef __cplusplus
using glm::uintBitsToFloat;
#endif

// Of one word: its bits as a float, or the word as a number.
FACET_CONSTANT uint ARITHMETIC_IDENTITY = 0u;
FACET_CONSTANT uint ARITHMETIC_NEGATION = 1u;
FACET_CONSTANT uint ARITHMETIC_ABS = 2u;
FACET_CONSTANT uint ARITHMETIC_FLOOR = 3u;
FACET_CONSTANT uint ARITHMETIC_SQRT = 4u;
FACET_CONSTANT uint ARITHMETIC_OF_UINT = 5u;
FACET_CONSTANT uint ARITHMETIC_OF_INT = 6u;
FACET_CONSTANT uint ARITHMETIC_TO_UINT = 7u;
FACET_CONSTANT uint ARITHMETIC_TO_INT = 8u;
FACET_CONSTANT uint ARITHMETIC_KINDS = 9u;  // bits: NaN, finite, zero, negative
// Of two numbers, or three.
FACET_CONSTANT uint ARITHMETIC_SUM = 10u;
FACET_CONSTANT uint ARITHMETIC_DIFFERENCE = 11u;
FACET_CONSTANT uint ARITHMETIC_PRODUCT = 12u;
FACET_CONSTANT uint ARITHMETIC_QUOTIENT = 13u;
FACET_CONSTANT uint ARITHMETIC_ORDER = 14u;  // bits: <, <=, ==, !=, >=, >
FACET_CONSTANT uint ARITHMETIC_MIN = 15u;
FACET_CONSTANT uint ARITHMETIC_MAX = 16u;
FACET_CONSTANT uint ARITHMETIC_PRODUCT_AND_SUM = 17u;        // a b + c
FACET_CONSTANT uint ARITHMETIC_SUM_OF_PRODUCTS = 18u;        // a b + a c
FACET_CONSTANT uint ARITHMETIC_SUMS_OF_CONSTANTS = 19u;      // (a + 0.1) + 0.7
FACET_CONSTANT uint ARITHMETIC_PRODUCTS_OF_CONSTANTS = 20u;  // (a * 1.1) * 1.3
FACET_CONSTANT uint ARITHMETIC_THIRD = 21u;                  // a / 3

FACET_CONSTANT uint FUNCTION_EXP = 0u;
FACET_CONSTANT uint FUNCTION_LOG = 1u;
FACET_CONSTANT uint FUNCTION_SINE = 2u;
FACET_CONSTANT uint FUNCTION_COSINE = 3u;
FACET_CONSTANT uint FUNCTION_ATAN = 4u;   // of a word and 1
FACET_CONSTANT uint FUNCTION_ATAN2 = 5u;  // of two edge numbers
FACET_CONSTANT uint FUNCTION_ERFC = 6u;
FACET_CONSTANT uint FUNCTION_ERFINV = 7u;
// Of model_numbers: (a, b, alpha, eta).
FACET_CONSTANT uint FUNCTION_FRESNEL_DIELECTRIC = 8u;     // cosine a, indices 1 and eta
FACET_CONSTANT uint FUNCTION_FRESNEL_TRANSMITTANCE = 9u;  // the same
FACET_CONSTANT uint FUNCTION_FRESNEL_SCHLICK = 10u;       // cosine a, b at normal incidence
FACET_CONSTANT uint FUNCTION_FRESNEL_CONDUCTOR = 11u;     // cosine a, index eta + 1000 b^2 i
FACET_CONSTANT uint FUNCTION_BECKMANN_D = 12u;            // half vector (a, 0, b)
FACET_CONSTANT uint FUNCTION_GGX_D = 13u;                 // the same
FACET_CONSTANT uint FUNCTION_BECKMANN_G1_RATIONAL = 14u;  // direction (a, 0, b)
FACET_CONSTANT uint FUNCTION_BECKMANN_G1_EXACT = 15u;     // the same
FACET_CONSTANT uint FUNCTION_GGX_G1 = 16u;                // the same
FACET_CONSTANT uint FUNCTION_VISIBLE_SLOPE = 17u;         // cosine of view a, number b
FACET_CONSTANT uint FUNCTION_COSINE_HEMISPHERE_X = 18u;   // numbers (a, b)
FACET_CONSTANT uint FUNCTION_COSINE_HEMISPHERE_Y = 19u;
FACET_CONSTANT uint FUNCTION_COSINE_HEMISPHERE_Z = 20u;
FACET_CONSTANT uint FUNCTION_TRIANGLE_U = 21u;  // numbers (a, b)
FACET_CONSTANT uint FUNCTION_TRIANGLE_V = 22u;
FACET_CONSTANT uint FUNCTION_QUOTIENT = 23u;     // of wide_quotient, in whole numbers
FACET_CONSTANT uint FUNCTION_OFFSET_USED = 24u;  // of extreme_corner and leaving_numbers
// Of extreme_corner, seen from extreme_viewer, and of the weights in leaving_numbers as (u, v).
FACET_CONSTANT uint FUNCTION_SEEN_SOLID_ANGLE = 25u;
FACET_CONSTANT uint FUNCTION_SEEN_POINT_B1 = 26u;
FACET_CONSTANT uint FUNCTION_SEEN_POINT_B2 = 27u;

/// Bits of a float that is often at an edge of something: half of them are of any kind and size,
/// the others are near powers of two, denormal, infinite, NaN, 0, the least or largest, or of a
/// middle size.
FACET_FUNCTION uint edge_number(uint word, uint kind) {
  uint sign = word & 0x80000000u;
  // Few bits set at the lower end, or few missing below.
  uint few = (kind & 0x100u) != 0u ? (0x007fffffu & ~((kind >> 9u) & 3u)) : ((kind >> 9u) & 3u);
  uint exponent = word & 0x7f800000u;
  uint mantissa = word & 0x007fffffu;
  uint middle = sign | ((119u + ((kind >> 11u) & 15u)) << 23u);
  uint which = kind & 7u;
  if (which == 4u) return sign | exponent | few;
  if (which == 5u) return sign | (mantissa >> ((kind >> 11u) & 15u));
  if (which == 6u) return middle | mantissa;
  if (which == 7u) {
    uint end = (kind & 16u) != 0u ? 0x7f7ffffcu : 0u;
    return (kind & 8u) != 0u ? (middle | few) : (sign | (end + few));
  }
  return word;
}

/// Bits of three edge numbers. The second is, half of the time, within some units in the last place
/// of the first or of its negative, where sums cancel.
FACET_FUNCTION uvec4 edge_numbers(uint index) {
  uvec4 words = pcg4d(uvec4(index, 0u, 0u, 0x243f6a88u));
  uvec4 kinds = pcg4d(uvec4(index, 1u, 0u, 0x243f6a88u));
  uint first = edge_number(words.x, kinds.x);
  uint near = (first ^ (kinds.w & 0x80000000u)) + ((words.w & 0xffu) >> (kinds.w & 7u));
  uint second = (kinds.w & 8u) != 0u ? near : edge_number(words.y, kinds.y);
  return uvec4(first, second, edge_number(words.z, kinds.z), 0u);
}

/// A number from 0 up to, but not, 1, half of the time near either end.
FACET_FUNCTION float edge_fraction(uint word, uint kind) {
  uint which = kind & 3u;
  uint shift = 8u + ((kind >> 2u) & 15u);
  if (which == 0u) return uintBitsToFloat(0x3f800000u - ((word >> shift) | 1u));
  if (which == 1u) return uintBitsToFloat(0x33800000u + word % 0x0b800000u);
  if (which == 2u && (kind & 0xf0u) == 0u) return 0.0f;
  return float(word >> 8u) * 5.96046448e-8f;
}

/// Two fractions, a roughness from 1e-4 to 1, and a ratio of indices from 1/4 to 4, often at or
/// near 1.
FACET_FUNCTION vec4 model_numbers(uint index) {
  uvec4 words = pcg4d(uvec4(index, 2u, 0u, 0x243f6a88u));
  uvec4 kinds = pcg4d(uvec4(index, 3u, 0u, 0x243f6a88u));
  uint alpha = 0x38d1b717u + words.z % 0x06ae48eau;
  if ((kinds.z & 15u) == 0u) alpha = 0x38d1b717u;
  if ((kinds.z & 15u) == 1u) alpha = 0x3f800000u;
  uint ratio = 0x3e800000u + words.w % 0x02000001u;
  uint near = words.w >> (8u + ((kinds.w >> 4u) & 15u));
  if ((kinds.w & 3u) == 0u) ratio = 0x3f800000u + near;
  if ((kinds.w & 3u) == 1u) ratio = 0x3f800000u - near;
  if ((kinds.w & 15u) == 2u) ratio = 0x3f800000u;
  return vec4(edge_fraction(words.x, kinds.x), edge_fraction(words.y, kinds.y),
              uintBitsToFloat(alpha), uintBitsToFloat(ratio));
}

/// A dividend of 64 bits and a divisor above its upper half: (high, low, divisor), divisors of all
/// sizes, and dividends of every fourth index the largest there are.
FACET_FUNCTION uvec4 wide_quotient(uint index) {
  uvec4 words = pcg4d(uvec4(index, 4u, 0u, 0x243f6a88u));
  uint divisor = (words.x >> (words.w & 31u)) | 1u;
  bool largest = (index & 3u) == 0u;
  return uvec4(largest ? divisor - 1u : words.y % divisor, largest ? 0xffffffffu : words.z, divisor,
               0u);
}

/// Three numbers from -1 to 1.
FACET_FUNCTION vec3 signed_numbers(uint index, uint which) {
  uvec4 words = pcg4d(uvec4(index, which, 0u, 0x243f6a88u));
  return vec3(float(words.x >> 8u), float(words.y >> 8u), float(words.z >> 8u)) * 1.1920929e-7f -
         vec3(1.0f);
}

/// Size of a triangle, a power of two from 2^-15 to 1, and the point beside which it lies: the
/// origin, or any of coordinates up to 1.
FACET_FUNCTION vec4 extreme_place(uint index) {
  uvec4 kinds = pcg4d(uvec4(index, 5u, 0u, 0x243f6a88u));
  vec3 offset = (kinds.y & 3u) == 0u ? vec3(0.0f) : signed_numbers(index, 6u);
  return vec4(offset, 1.0f / float(1u << (kinds.x & 15u)));
}

/// Corner k of such a triangle. A third are needles, down to a 2^-13th as wide as long, and a third
/// lie in a plane of two axes.
FACET_FUNCTION vec3 extreme_corner(uint index, uint k) {
  uvec4 kinds = pcg4d(uvec4(index, 5u, 0u, 0x243f6a88u));
  vec3 a = signed_numbers(index, 7u);
  vec3 b = signed_numbers(index, 8u);
  vec3 c = signed_numbers(index, 9u);
  uint shape = kinds.z % 3u;
  if (shape == 1u) {
    float along = float(kinds.w >> 8u) * 5.96046448e-8f;
    c = a + along * (b - a) + c / float(1u << (kinds.w & 7u) << ((kinds.w >> 3u) & 7u));
  }
  if (shape == 2u) {
    b.y = a.y;
    c.y = a.y;
  }
  vec3 chosen = k == 0u ? a : (k == 1u ? b : c);
  vec4 place = extreme_place(index);
  return vec3(place.x, place.y, place.z) + place.w * chosen;
}

/// A point near that triangle, or up to 16 of its sizes away.
FACET_FUNCTION vec3 extreme_viewer(uint index) {
  uvec4 kinds = pcg4d(uvec4(index, 12u, 0u, 0x243f6a88u));
  vec4 place = extreme_place(index);
  return vec3(place.x, place.y, place.z) +
         place.w * (float(1u << (kinds.x & 3u) << (kinds.y & 1u)) * signed_numbers(index, 13u));
}

/// Weights of the second and third corner of a point of a triangle, and cosine and azimuth (in
/// turns) of a direction that leaves it; the cosine is negative for half of them, often near 0.
FACET_FUNCTION vec4 leaving_numbers(uint index) {
  uvec4 words = pcg4d(uvec4(index, 10u, 0u, 0x243f6a88u));
  uvec4 kinds = pcg4d(uvec4(index, 11u, 0u, 0x243f6a88u));
  float b1 = edge_fraction(words.x, kinds.x);
  float b2 = edge_fraction(words.y, kinds.y);
  float cosine = edge_fraction(words.z, kinds.z);
  return vec4(b1, (1.0f - b1) * b2, (kinds.w & 1u) == 0u ? cosine : -cosine,
              edge_fraction(words.w, kinds.w >> 1u));
}

FACET_SHARED_END
#endif
