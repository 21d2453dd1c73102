#pragma once
// A measured figure: the median of several runs, with their spread.
#include <algorithm>
#include <vector>

namespace facet {

struct Figure {
  double median = 0;
  double min = 0;
  double max = 0;
};

/// Of at least one value; the lower of the two middle ones where their number is even.
[[nodiscard]] inline Figure summarise(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[(values.size() - 1) / 2], values.front(), values.back()};
}

}  // namespace facet
