#pragma once
// Renders with different seeds, and what they say.
#include "tradeoff/tradeoff.h"

namespace facet::tradeoff {

/// Renders of a setting with one number of samples, a seed each.
struct Series {
  std::uint32_t samples = 0;
  std::vector<double> seconds;
  std::vector<double> default_seconds;  ///< of the default in the same rounds
  std::vector<RelativeError> errors;
  std::vector<Image> images;
  Film sum;  ///< of all
};

/// One render more.
void add(Series& series, const Film& film, double default_seconds, const Reference& reference);

/// What the series says beside that of the default with as many samples. reference_relmse: of the
/// reference itself.
[[nodiscard]] Point point_of(const Series& series, const Series& of_default,
                             double reference_relmse);

/// Sets what is expected of points of one number of samples, the default's the first.
///
/// A few rare bright pixels can make half of relmse, and a few renders do not tell how many of them
/// a setting has: whether one of them shows up decides more than the setting. Trimmed errors are
/// known far better. So the ratio of the two is taken to scatter around its median over all
/// settings by a factor of 1.25 (over 42 renders of seven settings of Veach's scene the logarithm's
/// deviation was 0.12), and a setting's own ratio counts as much as its renders agree on it: the
/// mean of both logarithms, weighted by the inverse of their variances. But where it lies far
/// above, as that of emitter sampling on smooth plates does, it is believed.
void expect(const std::vector<Point*>& points);

/// Slope of the line through the logarithms of relmse and samples; nothing of a single point.
[[nodiscard]] std::optional<double> slope_of(const std::vector<Point>& points);

/// Marks the points that no other one beats in time and error.
void mark_front(std::vector<Setting>& settings);

}  // namespace facet::tradeoff
