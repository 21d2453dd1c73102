#pragma once
// A quantity of every pixel.
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "image/film.h"

namespace facet {

/// Zero at first.
struct Plane {
  int width = 0;
  int height = 0;
  std::vector<double> values;

  explicit Plane(const Film& film)
      : width(film.width), height(film.height), values(film.pixels.size()) {}

  [[nodiscard]] double mean() const {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  }

  /// Means over squares of 2 r + 1 pixels, cut off at the borders.
  [[nodiscard]] Plane blurred(int r) const { return along(1, width, r).along(width, height, r); }

 private:
  /// Means over 2 r + 1 neighbours in one direction.
  [[nodiscard]] Plane along(int step, int count, int r) const {
    Plane result = *this;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const int place = static_cast<int>(i) / step % count;
      const int first = std::max(-r, -place);
      const int last = std::min(r, count - 1 - place);
      double sum = 0;
      for (std::ptrdiff_t k = first; k <= last; ++k)
        sum += values[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + k * step)];
      result.values[i] = sum / (last - first + 1);
    }
    return result;
  }
};

}  // namespace facet
