#pragma once
// Reconstruction filters: one-dimensional profiles, of which the image filter is the product over x and y.
#include <string>
#include <variant>

namespace facet {

/// exp(-x^2 / 2 stddev^2), shifted down to reach 0 at the radius.
struct GaussianFilter {
  double radius = 2;
  double stddev = 0.5;
};

/// Mitchell and Netravali 1988, stretched to the radius (2 in the paper).
struct MitchellFilter {
  double radius = 2;
  double b = 1.0 / 3;
  double c = 1.0 / 3;
};

/// 1 - |x|, radius 1.
struct TentFilter {};

/// Constant, radius 1/2.
struct BoxFilter {};

using Filter = std::variant<GaussianFilter, MitchellFilter, TentFilter, BoxFilter>;

/// Distance from the centre beyond which the filter is 0, pixels.
[[nodiscard]] double filter_radius(const Filter& filter);

/// Value at x pixels from the centre; not normalised.
[[nodiscard]] double filter_value(const Filter& filter, double x);

/// "mitchell, radius 2, B 0.5, C 0.25": all there is to a filter, for people and for comparisons.
[[nodiscard]] std::string describe(const Filter& filter);

}  // namespace facet
