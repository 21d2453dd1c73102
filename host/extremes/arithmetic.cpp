// The premise: what images that are the same in every bit on every device rest on. The host's own
// arithmetic is the yardstick; it is that of IEEE 754, with every operation rounded by itself.
#include <algorithm>
#include <cmath>
#include <limits>

#include "extremes/bench.h"
#include "shared/extreme_inputs.h"

namespace facet::extremes {

namespace {

using namespace shared;

constexpr const char* same_bits = "images are the same in every bit on every device";
constexpr const char* same_words =
    "numbers from words, and words from numbers, are the same everywhere";
constexpr const char* found_nan = "samples that are NaN or infinite are found and dropped";

std::uint32_t flag(bool condition, std::uint32_t bit) { return condition ? 1U << bit : 0U; }

/// Whether a device's result is the right one; one NaN is as good as another.
bool is_same(std::uint32_t result, float expected) {
  return result == as_word(expected) || (std::isnan(as_float(result)) && std::isnan(expected));
}

Finding finding_of(const Worst& worst, const std::string& at) {
  return {worst.inputs(), worst.sum(), worst.value() > 0 ? at : ""};
}

Check base_check(const char* name, const char* range, const char* promise) {
  Check check = make_check("premise", name, range, "wrong results", 0);
  check.promise = promise;
  return check;
}

/// A check over words; right(word, result).
template <typename Right>
Check of_words(const char* name, const char* range, const char* promise, std::uint32_t operation,
               std::vector<WordRange> ranges, const Right& right) {
  Check check = base_check(name, range, promise);
  check.measure = [operation, ranges = std::move(ranges), right](Bench& bench) {
    const Worst worst = bench.sweep(
        Kernel::arithmetic, operation, ranges,
        [&](std::uint32_t word, std::uint32_t result) { return right(word, result) ? 0.0 : 1.0; });
    return finding_of(worst, float_text(worst.word()));
  };
  return check;
}

/// One over edge numbers; right(a, b, c, result).
template <typename Right>
Check of_numbers(const char* name, const char* range, const char* promise, std::uint32_t operation,
                 int operands, const Right& right) {
  Check check = base_check(name, range, promise);
  check.measure = [operation, operands, right](Bench& bench) {
    constexpr std::array all{WordRange{0, 1U << 30U}};
    const Worst worst = bench.sweep(
        Kernel::arithmetic, operation, all, [&](std::uint32_t index, std::uint32_t result) {
          const uvec4 words = edge_numbers(index);
          return right(as_float(words.x), as_float(words.y), as_float(words.z), result) ? 0.0 : 1.0;
        });
    const uvec4 words = edge_numbers(worst.word());
    std::string at = float_text(words.x);
    for (int i = 1; i < operands; ++i) at += ", " + float_text(words[i]);
    return finding_of(worst, at);
  };
  return check;
}

constexpr WordRange all_words{0, std::uint64_t{1} << 32U};
constexpr const char* all_floats = "all floats";
constexpr const char* edge_pairs = "pairs of floats at edges";
constexpr const char* edge_triples = "triples of floats at edges";

void add_of_one(std::vector<Check>& checks) {
  const auto add = [&](const char* name, std::uint32_t operation, auto function) {
    checks.push_back(of_words(name, all_floats, same_bits, operation, {all_words},
                              [function](std::uint32_t word, std::uint32_t result) {
                                return is_same(result, function(as_float(word)));
                              }));
  };
  checks.push_back(of_words(
      "load and store", "all words", same_words, ARITHMETIC_IDENTITY, {all_words},
      [](std::uint32_t word, std::uint32_t result) { return is_same(result, as_float(word)); }));
  add("-x", ARITHMETIC_NEGATION, [](float x) { return -x; });
  add("abs", ARITHMETIC_ABS, [](float x) { return std::abs(x); });
  add("floor", ARITHMETIC_FLOOR, [](float x) { return std::floor(x); });
  add("sqrt", ARITHMETIC_SQRT, [](float x) { return std::sqrt(x); });
  checks.push_back(of_words("NaN, infinity, zero, sign", all_floats, found_nan, ARITHMETIC_KINDS,
                            {all_words}, [](std::uint32_t word, std::uint32_t result) {
                              const float x = as_float(word);
                              return result == (flag(std::isnan(x), 0) | flag(std::isfinite(x), 1) |
                                                flag(x == 0, 2) | flag(x < 0, 3));
                            }));
}

void add_conversions(std::vector<Check>& checks) {
  checks.push_back(of_words("float(uint)", "all words", same_words, ARITHMETIC_OF_UINT, {all_words},
                            [](std::uint32_t word, std::uint32_t result) {
                              return result == as_word(static_cast<float>(word));
                            }));
  checks.push_back(of_words("float(int)", "all words", same_words, ARITHMETIC_OF_INT, {all_words},
                            [](std::uint32_t word, std::uint32_t result) {
                              const auto x = static_cast<float>(static_cast<std::int32_t>(word));
                              return result == as_word(x);
                            }));
  constexpr float largest_uint = 4294967040.0F;
  constexpr float largest_int = 2147483520.0F;
  checks.push_back(of_words("uint(float)", "all floats from 0 to 2^32", same_words,
                            ARITHMETIC_TO_UINT, {floats(0, largest_uint)},
                            [](std::uint32_t word, std::uint32_t result) {
                              return result == static_cast<std::uint32_t>(as_float(word));
                            }));
  checks.push_back(of_words(
      "int(float)", "all floats from -2^31 to 2^31", same_words, ARITHMETIC_TO_INT,
      {floats(0, largest_int), floats(-0.0F, -2147483648.0F)},
      [](std::uint32_t word, std::uint32_t result) {
        return static_cast<std::int32_t>(result) == static_cast<std::int32_t>(as_float(word));
      }));
}

void add_of_two(std::vector<Check>& checks) {
  const auto add = [&](const char* name, std::uint32_t operation, auto function) {
    checks.push_back(of_numbers(name, edge_pairs, same_bits, operation, 2,
                                [function](float a, float b, float /*c*/, std::uint32_t result) {
                                  return is_same(result, function(a, b));
                                }));
  };
  add("a + b", ARITHMETIC_SUM, [](float a, float b) { return a + b; });
  add("a - b", ARITHMETIC_DIFFERENCE, [](float a, float b) { return a - b; });
  add("a b", ARITHMETIC_PRODUCT, [](float a, float b) { return a * b; });
  add("a / b", ARITHMETIC_QUOTIENT, [](float a, float b) { return a / b; });
  checks.push_back(of_numbers("<, <=, ==, !=, >=, >", edge_pairs, same_bits, ARITHMETIC_ORDER, 2,
                              [](float a, float b, float /*c*/, std::uint32_t result) {
                                return result ==
                                       (flag(a < b, 0) | flag(a <= b, 1) | flag(a == b, 2) |
                                        flag(a != b, 3) | flag(a >= b, 4) | flag(a > b, 5));
                              }));
  // Which of 0 and -0, and what of NaN, GLSL leaves open.
  const auto add_extremum = [&](const char* name, std::uint32_t operation, auto function) {
    checks.push_back(of_numbers(name, "pairs of floats at edges, without NaN", same_bits, operation,
                                2, [function](float a, float b, float /*c*/, std::uint32_t result) {
                                  return std::isnan(a) || std::isnan(b) ||
                                         as_float(result) == function(a, b);
                                }));
  };
  add_extremum("min", ARITHMETIC_MIN, [](float a, float b) { return std::min(a, b); });
  add_extremum("max", ARITHMETIC_MAX, [](float a, float b) { return std::max(a, b); });
}

void add_of_several(std::vector<Check>& checks) {
  const auto add = [&](const char* name, const char* range, std::uint32_t operation, int operands,
                       auto function) {
    checks.push_back(of_numbers(name, range, same_bits, operation, operands,
                                [function](float a, float b, float c, std::uint32_t result) {
                                  return is_same(result, function(a, b, c));
                                }));
  };
  constexpr const char* numbers = "floats at edges";
  add("a b + c, rounded twice", edge_triples, ARITHMETIC_PRODUCT_AND_SUM, 3,
      [](float a, float b, float c) { return a * b + c; });
  add("a b + a c, in this order", edge_triples, ARITHMETIC_SUM_OF_PRODUCTS, 3,
      [](float a, float b, float c) { return a * b + a * c; });
  add("(a + 0.1) + 0.7, in this order", numbers, ARITHMETIC_SUMS_OF_CONSTANTS, 1,
      [](float a, float /*b*/, float /*c*/) { return (a + 0.1F) + 0.7F; });
  add("(a * 1.1) * 1.3, in this order", numbers, ARITHMETIC_PRODUCTS_OF_CONSTANTS, 1,
      [](float a, float /*b*/, float /*c*/) { return (a * 1.1F) * 1.3F; });
  add("a / 3, not by a reciprocal", numbers, ARITHMETIC_THIRD, 1,
      [](float a, float /*b*/, float /*c*/) { return a / 3.0F; });
}

}  // namespace

std::vector<Check> arithmetic_checks() {
  std::vector<Check> checks;
  add_of_one(checks);
  add_conversions(checks);
  add_of_two(checks);
  add_of_several(checks);
  return checks;
}

}  // namespace facet::extremes
