// Discrete choices by cumulative counts (docs/reference/sampling.md, "Choices").
#ifndef FACET_CHOICE_GLSL
#define FACET_CHOICE_GLSL

/// A word for a choice; the last cumulative count is 2^32 - 1.
uint choice_word(uint bits) { return min(bits, 0xfffffffeu); }

/// The next digit of a long division by d to base 2^16. `upper` is what is left to divide, less
/// than d; `next` the dividend's next digit; inverse: of d, whose rounding the estimate of the
/// digit leaves room for.
uint quotient_digit(inout uint upper, uint next, uint d, float inverse) {
  uint q = uint(max((float(upper) * 65536.0 + float(next)) * inverse - 0.0625, 0.0));
  uint high;
  uint low;
  umulExtended(q + 1u, d, high, low);
  uint rest = (upper << 16u) | next;
  uint above = upper >> 16u;
  q = high < above || (high == above && low <= rest) ? q + 1u : q;
  upper = rest - q * d;
  return q;
}

/// floor((2^32 high + low) / divisor) for high < divisor, exactly.
uint divide_wide(uint high, uint low, uint divisor) {
  float inverse = 1.0 / float(divisor);
  uint upper = high;
  uint first = quotient_digit(upper, low >> 16u, divisor, inverse);
  return (first << 16u) | quotient_digit(upper, low & 0xffffu, divisor, inverse);
}

/// What is left of a word that a choice has found to lie in [begin, end): a word again, uniform if
/// `bits` and `fill` are.
uint remainder_word(uint bits, uint begin, uint end, uint fill) {
  uint rest = divide_wide(bits - begin, fill, max(end - begin, 1u));
  return end - begin == 0xffffffffu ? bits : rest;
}

/// A probability rounded down to a whole number of words.
float whole_words(float p) { return floor(p * 4294967296.0) * 2.3283064365386963e-10; }

/// How many words choose the first of two, of probability p < 1.
uint words_of(float p) { return uint(min(p, 0.99999994) * 4294967296.0); }

/// Whether a word chooses the first of two, of probability p in whole words.
bool is_first(uint bits, float p) { return p >= 1.0 || bits < words_of(p); }

/// The same, and leaves the remainder of the word.
bool choose_first(inout uint bits, float p, uint fill) {
  uint words = words_of(p);
  bool first = is_first(bits, p);
  uint begin = first ? 0u : words;
  uint rest = divide_wide(bits - begin, fill, first ? max(words, 1u) : 0u - max(words, 1u));
  bits = p >= 1.0 || words == 0u ? bits : rest;
  return first;
}

/// Probability of the first of two by weights: that of the lesser one is rounded to seven
/// significant bits, so that rounding before hardly ever changes it and with it all that its words
/// decide later. 1 where both are 0.
float first_share(float first, float second) {
  float sum = first + second;
  float lesser = sum > 0.0 ? min(first, second) / sum : 0.0;
  float rounded = uintBitsToFloat((floatBitsToUint(lesser) + 0x10000u) & 0xfffe0000u);
  rounded = lesser > 0.0 ? max(rounded, 7.62939453e-6) : 0.0;
  return first < second ? rounded : 1.0 - rounded;
}

/// Defines uint name(uint low, uint high, uint bits): the first i of [low, high] with bits <
/// CUMULATIVE(i). A macro, since GLSL cannot hand a buffer to a function. 32 halvings reach one
/// entry from any range.
#define FACET_DEFINE_CHOICE(name, CUMULATIVE)  \
  uint name(uint low, uint high, uint bits) {  \
    uint k = 0u;                               \
    while (low < high && k < 32u) {            \
      uint middle = low + (high - low) / 2u;   \
      bool below = CUMULATIVE(middle) <= bits; \
      low = below ? middle + 1u : low;         \
      high = below ? high : middle;            \
      ++k;                                     \
    }                                          \
    return low;                                \
  }

#endif
