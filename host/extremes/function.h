#pragma once
// Functions of words on the device beside the same ones in double and in many more digits.
#include <string>

#include "extremes/bench.h"
#include "extremes/exact.h"

namespace facet::extremes {

/// Unit in the last place of a float of this value.
[[nodiscard]] double ulp_of(double value);

/// A function of a word, with the yardstick of its error.
struct Function {
  std::uint32_t number = 0;
  std::function<double(std::uint32_t)> in_double;
  std::function<Exact(std::uint32_t)> exact;
  /// What the error is measured in, of the word and the value; below 0 where the word is no input.
  std::function<double(std::uint32_t, double)> yardstick;
  /// The input that a word stands for.
  std::function<std::string(std::uint32_t)> name;
};

/// Of the float with these bits; call(x) in double and in 160 bits.
template <typename Call>
Function of_float(std::uint32_t number, const Call& call) {
  Function f;
  f.number = number;
  f.in_double = [call](std::uint32_t word) { return call(static_cast<double>(as_float(word))); };
  f.exact = [call](std::uint32_t word) { return call(Exact(as_float(word))); };
  f.yardstick = [](std::uint32_t /*word*/, double value) { return ulp_of(value); };
  f.name = float_text;
  return f;
}

/// How far the device's function is from the true one, over all words of some ranges. The scan
/// measures in double, whose functions err by a millionth of a float's last place or less; the
/// worst input is then measured again in 160 bits.
[[nodiscard]] Check check_of(const char* group, const char* name, const char* range, double limit,
                             Function function, std::vector<WordRange> ranges);

}  // namespace facet::extremes
