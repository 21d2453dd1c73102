#include "extremes/function.h"

#include <cmath>

namespace facet::extremes {

namespace {

Finding measure(Bench& bench, const Function& f, std::span<const WordRange> ranges) {
  const Worst worst = bench.sweep(
      Kernel::functions, f.number, ranges, [&](std::uint32_t word, std::uint32_t result) {
        const double expected = f.in_double(word);
        const double yardstick = f.yardstick(word, expected);
        return yardstick < 0 ? -1 : std::abs(as_float(result) - expected) / yardstick;
      });
  if (worst.value() == 0) return {worst.inputs(), 0, ""};
  const std::array once{WordRange{worst.word(), 1}};
  const Worst again =
      bench.sweep(Kernel::functions, f.number, once, [&](std::uint32_t word, std::uint32_t result) {
        const Exact expected = f.exact(word);
        const auto error = static_cast<double>(abs(Exact(as_float(result)) - expected));
        return error / f.yardstick(word, static_cast<double>(expected));
      });
  // Were double too coarse somewhere, it would show here.
  return {worst.inputs(), std::max(worst.value(), again.value()), f.name(worst.word())};
}

}  // namespace

double ulp_of(double value) {
  constexpr int least_exponent = -126;
  if (!(std::abs(value) >= std::ldexp(1.0, least_exponent))) return std::ldexp(1.0, -149);
  return std::ldexp(1.0, std::ilogb(value) - 23);
}

Check check_of(const char* group, const char* name, const char* range, double limit,
               Function function, std::vector<WordRange> ranges) {
  Check check = make_check(group, name, range, "ulp", limit);
  check.measure = [function = std::move(function), ranges = std::move(ranges)](Bench& bench) {
    return measure(bench, function, ranges);
  };
  return check;
}

}  // namespace facet::extremes
