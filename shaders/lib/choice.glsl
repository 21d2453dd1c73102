// Discrete choices by cumulative counts (docs/sampling.md, "Choices").
#ifndef FACET_CHOICE_GLSL
#define FACET_CHOICE_GLSL

/// A word for a choice; the last cumulative count is 2^32 - 1.
uint choice_word(uint bits) { return min(bits, 0xfffffffeu); }

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
