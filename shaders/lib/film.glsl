// Sums that do not stall: 2^24 samples and more a pixel keep their digits.
#ifndef FACET_FILM_GLSL
#define FACET_FILM_GLSL
#include "../shared/records.h"
#include "constants.glsl"

/// Finite and not negative, looked at in the bits: comparisons with NaN may be optimised away.
bool is_good_sample(vec3 radiance) {
  uvec3 bits = floatBitsToUint(radiance);
  // -0 is good; every other number with the sign bit, and everything from infinity on, is not.
  bvec3 good = lessThan(bits & uvec3(bits.x == 0x80000000u ? 0x7fffffffu : 0xffffffffu,
                                     bits.y == 0x80000000u ? 0x7fffffffu : 0xffffffffu,
                                     bits.z == 0x80000000u ? 0x7fffffffu : 0xffffffffu),
                        uvec3(0x7f800000u));
  return all(good);
}

/// Adds x to hi + lo; hi takes the rounded sum, lo gathers what rounding loses (D. Knuth's
/// two-sum).
void add_compensated(inout vec3 hi, inout vec3 lo, vec3 x) {
  vec3 sum = hi + x;
  vec3 part = sum - hi;
  vec3 lost = (hi - (sum - part)) + (x - part);
  lo += lost;
  // hi + lo is normalised again, so that lo stays small beside hi.
  hi = sum + lo;
  lo = lo - (hi - sum);
}

/// x^2 = square + rest, exactly while neither over- nor underflows (T. J. Dekker 1971). Without the
/// rest a variance far below the squared mean would drown in rounding.
void square_exactly(vec3 x, out vec3 square, out vec3 rest) {
  square = x * x;
  vec3 c = 4097.0 * x;
  vec3 high = c - (c - x);
  vec3 low = x - high;
  rest = ((high * high - square) + 2.0 * (high * low)) + low * low;
}

/// Adds the square of a scaled value to sums of squares.
void add_square(inout FilmRecord pixel, vec3 scaled) {
  vec3 hi = vec3(pixel.hi_r, pixel.hi_g, pixel.hi_b);
  vec3 lo = vec3(pixel.lo_r, pixel.lo_g, pixel.lo_b);
  vec3 square;
  vec3 rest;
  square_exactly(scaled, square, rest);
  add_compensated(hi, lo, square);
  lo += rest;
  pixel = FilmRecord(hi.r, hi.g, hi.b, pixel.samples + 1u, lo.r, lo.g, lo.b, pixel.nonzero);
}

/// One sample more.
void add_sample(inout FilmRecord pixel, vec3 value) {
  vec3 hi = vec3(pixel.hi_r, pixel.hi_g, pixel.hi_b);
  vec3 lo = vec3(pixel.lo_r, pixel.lo_g, pixel.lo_b);
  add_compensated(hi, lo, value);
  uint nonzero = pixel.nonzero + (any(notEqual(value, vec3(0.0))) ? 1u : 0u);
  pixel = FilmRecord(hi.r, hi.g, hi.b, pixel.samples + 1u, lo.r, lo.g, lo.b, nonzero);
}

#endif
