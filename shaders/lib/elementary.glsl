// Elementary functions of our own. The drivers' built-in ones differ between drivers and are poor
// in places (log near 1, acos, atan); these are the same in every bit wherever + - * / and sqrt are
// correctly rounded. Stated errors hold for every float of
// the range (docs/reference/extremes.md).
#ifndef FACET_ELEMENTARY_GLSL
#define FACET_ELEMENTARY_GLSL
#include "../shared/elementary_coefficients.h"
#include "constants.glsl"

const float EXP_C[5] = float[5](FACET_EXP_COEFFICIENTS);
const float LOG_C[9] = float[9](FACET_LOG_COEFFICIENTS);
const float SIN_C[3] = float[3](FACET_SIN_COEFFICIENTS);
const float COS_C[3] = float[3](FACET_COS_COEFFICIENTS);
const float ATAN_C[5] = float[5](FACET_ATAN_COEFFICIENTS);
const float ERFCX_C[11] = float[11](FACET_ERFCX_COEFFICIENTS);
const float ERFINV_CENTRAL_C[10] = float[10](FACET_ERFINV_CENTRAL_COEFFICIENTS);
const float ERFINV_TAIL_C[9] = float[9](FACET_ERFINV_TAIL_COEFFICIENTS);

/// e^x. 0 below -87, e^88 above 88. At most 1.047 ulp.
float exp_accurate(float x) {
  float y = min(max(x, -87.0), 88.0);
  float k = floor(y * 1.44269504 + 0.5);
  float r =
      (y - k * 0.693359375) + k * 2.12194440e-4;  // ln 2 in two parts; the first product is exact
  float p = EXP_C[0] + r * (EXP_C[1] + r * (EXP_C[2] + r * (EXP_C[3] + r * EXP_C[4])));
  float e = 1.0 + (r + r * r * p);
  // k = 127 at most, so the scale is a normal number.
  float scale = uintBitsToFloat(uint(int(k) + 127) << 23);
  return x < -87.0 ? 0.0 : e * scale;
}

/// Natural logarithm of a positive normal number. At most 0.83 ulp.
float log_accurate(float x) {
  uint bits = floatBitsToUint(x);
  // The mantissa is brought into [sqrt(1/2), sqrt(2)).
  int e = int(bits - 0x3f3504f3u) >> 23;
  float f = uintBitsToFloat(bits - (uint(e) << 23)) - 1.0;
  float f2 = f * f;
  float p = LOG_C[0] +
            f * (LOG_C[1] +
                 f * (LOG_C[2] +
                      f * (LOG_C[3] +
                           f * (LOG_C[4] +
                                f * (LOG_C[5] + f * (LOG_C[6] + f * (LOG_C[7] + f * LOG_C[8])))))));
  float k = float(e);
  float low = f2 * f * p - k * 2.12194440e-4;
  return ((low - 0.5 * f2) + f) + k * 0.693359375;
}

/// sin(2 pi u) and cos(2 pi u), 0 <= u <= 1. At most 1.81 ulp.
vec2 sincos_turns(float u) {
  float quadrant = floor(u * 4.0 + 0.5);
  float turns = u - quadrant * 0.25;  // exact
  float x = turns * TWO_PI;           // |x| <= pi/4; TWO_PI is 1.7e-7 more than 2 pi
  float z = x * x;
  float s = x + (x * z * (SIN_C[0] + z * (SIN_C[1] + z * SIN_C[2])) - turns * 1.74845553e-7);
  float c = (1.0 - 0.5 * z) + z * z * (COS_C[0] + z * (COS_C[1] + z * COS_C[2]));
  uint q = uint(quadrant) & 3u;
  bool odd = (q & 1u) != 0u;
  float sine = odd ? c : s;
  float cosine = odd ? s : c;
  return vec2((q & 2u) != 0u ? -sine : sine, (q == 1u || q == 2u) ? -cosine : cosine);
}

/// Angle of the vector (x, y) in radians, in [-pi, pi]; 0 for the zero vector. At most 2.9 ulp.
float atan2_accurate(float y, float x) {
  float ax = abs(x);
  float ay = abs(y);
  float large = max(ax, ay);
  float a = large > 0.0 ? min(ax, ay) / large : 0.0;
  bool reduce = a > 0.414213562;  // tan(pi/8)
  float t = reduce ? (a - 1.0) / (a + 1.0) : a;
  float z = t * t;
  float p =
      t + t * z * (ATAN_C[0] + z * (ATAN_C[1] + z * (ATAN_C[2] + z * (ATAN_C[3] + z * ATAN_C[4]))));
  float angle = reduce ? 0.785398163 + p : p;
  angle = ay > ax ? 1.57079633 - angle : angle;
  angle = x < 0.0 ? PI - angle : angle;
  return y < 0.0 ? -angle : angle;
}

/// 1 - erf(x), accurate in the tail: relative error at most 5e-7 (1 + x^2).
float erfc_accurate(float x) {
  float a = abs(x);
  float t = 1.0 / (1.0 + a * 0.333333333);
  float q = ERFCX_C[0] +
            t * (ERFCX_C[1] +
                 t * (ERFCX_C[2] +
                      t * (ERFCX_C[3] +
                           t * (ERFCX_C[4] +
                                t * (ERFCX_C[5] +
                                     t * (ERFCX_C[6] +
                                          t * (ERFCX_C[7] +
                                               t * (ERFCX_C[8] +
                                                    t * (ERFCX_C[9] + t * ERFCX_C[10])))))))));
  float tail = exp_accurate(-a * a) * (t * q);
  return x < 0.0 ? 2.0 - tail : tail;
}

/// The x with erf(x) = 2 u - 1, for u in [2^-25, 1 - 2^-25]: the quantile of a normal variable of
/// variance 1/2. Written in u so that neither tail loses digits. Relative error at most 4e-7.
float erfinv_quantile(float u) {
  float w = -log_accurate(4.0 * (u * (1.0 - u)));
  float c = w - 2.5;
  float t = sqrt(max(w, 0.0)) - 3.0;
  float central =
      ERFINV_CENTRAL_C[0] +
      c * (ERFINV_CENTRAL_C[1] +
           c * (ERFINV_CENTRAL_C[2] +
                c * (ERFINV_CENTRAL_C[3] +
                     c * (ERFINV_CENTRAL_C[4] +
                          c * (ERFINV_CENTRAL_C[5] +
                               c * (ERFINV_CENTRAL_C[6] +
                                    c * (ERFINV_CENTRAL_C[7] +
                                         c * (ERFINV_CENTRAL_C[8] + c * ERFINV_CENTRAL_C[9]))))))));
  float tail = ERFINV_TAIL_C[0] +
               t * (ERFINV_TAIL_C[1] +
                    t * (ERFINV_TAIL_C[2] +
                         t * (ERFINV_TAIL_C[3] +
                              t * (ERFINV_TAIL_C[4] +
                                   t * (ERFINV_TAIL_C[5] +
                                        t * (ERFINV_TAIL_C[6] +
                                             t * (ERFINV_TAIL_C[7] + t * ERFINV_TAIL_C[8])))))));
  return (2.0 * u - 1.0) * (w <= 5.0 ? central : tail);
}

#endif
