#pragma once
// The reconstruction filter as a table from which pixel offsets are sampled
// (docs/reference/sampling.md, "Filter").
#include <vector>

#include "core/maths.h"
#include "scene/filter.h"

namespace facet {

struct FilterTable {
  std::vector<vec2> quantiles;  ///< (offset, |filter| there) at the borders of intervals of equal
                                ///< mass of |filter|
  float crossing = 0;           ///< |offset| beyond which the filter is negative
  float scale =
      1;  ///< integral of |filter| over integral of filter: magnitude of a sample's weight

  [[nodiscard]] std::uint32_t intervals() const {
    return static_cast<std::uint32_t>(quantiles.size() - 1);
  }
};

/// Throws InputError for a filter whose integral is not positive.
[[nodiscard]] FilterTable make_filter_table(const Filter& filter);

}  // namespace facet
