#pragma once
// Histograms of a comparison's pixels.
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

namespace facet::report {

/// Decades that hold the positive finite values, at most six below the largest; {0, 1} where there
/// are none.
struct Decades {
  int first = 0;  ///< from 10^first
  int end = 1;    ///< to 10^end
};
[[nodiscard]] Decades decades_of(std::span<const double> values);

struct Histogram {
  std::string title;
  std::string axis;          ///< what the values are
  bool logarithmic = false;  ///< over decades_of the values, else over [0, 1]
  double mark = 0;           ///< a value to mark, where it lies on the axis
  std::string mark_name;
};

/// The histogram, its `counts` in 60 bins between `low` and `high` (exponents of 10 where it is
/// logarithmic), and in `beside` sentences on the values that the axis cannot hold (0 on a
/// logarithmic one, infinite, NaN).
[[nodiscard]] nlohmann::ordered_json histogram_json(const Histogram& histogram,
                                                    std::span<const double> values);

}  // namespace facet::report
