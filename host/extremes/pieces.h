#pragma once
// Functions of a few numbers that models are made of: how they are measured.
#include <fmt/format.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <limits>

#include "extremes/function.h"
#include "shared/extreme_inputs.h"

namespace facet::extremes {

inline constexpr const char* pieces_group = "pieces of models";
/// Inputs of each in a whole measurement.
inline constexpr WordRange piece_inputs{0, 1U << 24U};

/// What a function may take, of an index.
template <typename Real>
struct Numbers {
  Real a, b, alpha, eta;

  explicit Numbers(std::uint32_t index) {
    const vec4 n = shared::model_numbers(index);
    a = n.x, b = n.y, alpha = n.z, eta = n.w;
  }
};

inline std::string text_of_model_numbers(std::uint32_t index) {
  const vec4 n = shared::model_numbers(index);
  return fmt::format("a = {:.9g}, b = {:.9g}, alpha = {:.9g}, eta = {:.9g}", n.x, n.y, n.z, n.w);
}

/// call(numbers) in double and in 160 bits; errors are relative to the value.
template <typename Call>
Function of_model_numbers(std::uint32_t number, const Call& call) {
  Function f;
  f.number = number;
  f.in_double = [call](std::uint32_t index) { return call(Numbers<double>(index)); };
  f.exact = [call](std::uint32_t index) { return call(Numbers<Exact>(index)); };
  f.yardstick = [](std::uint32_t /*index*/, double value) {
    return std::max(std::abs(value), static_cast<double>(std::numeric_limits<float>::min()));
  };
  f.name = text_of_model_numbers;
  return f;
}

inline Check relative_check(const char* name, const char* range, double limit, Function function) {
  Check check = check_of(pieces_group, name, range, limit, std::move(function), {piece_inputs});
  check.unit = "relative error";
  return check;
}

/// Adds those of reflectances.
void add_reflectances(std::vector<Check>& checks);

}  // namespace facet::extremes
