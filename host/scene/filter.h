#pragma once
// Reconstruction filters: one-dimensional profiles, of which the image filter is the product over x
// and y.
#include <string>
#include <variant>

#include "scene/plugin/parameter.h"

namespace facet {

class PropertyReader;

/* gaussian: a Gaussian, shifted down to reach 0 at its radius.

   exp(-x^2/(2 stddev^2)) - exp(-radius^2/(2 stddev^2)), the product over x and y. Samples are
   spread by the filter: no pixel depends on another's. */
struct GaussianFilter {
  double radius = 2;
  double stddev = 0.5;

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    visit("radius", p.radius, parameter::Between{0.01, 100}, "pixels");
    visit("stddev", p.stddev, parameter::Between{0.01, 100}, "standard deviation, pixels");
  }
};

/* mitchell: the cubic filters of Mitchell and Netravali 1988, stretched to the radius.

   Negative in parts: such samples are subtracted. B and C may be any for which it is positive at
   the centre, changes its sign once at most on the way out, and has a positive integral: B from 0
   to 1 with C from 0 to 1 are among them. */
struct MitchellFilter {
  double radius = 2;
  double b = 1.0 / 3;
  double c = 1.0 / 3;

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    visit("radius", p.radius, parameter::Between{0.01, 100}, "pixels; in the paper 2");
    visit("B", p.b, parameter::Between{-10, 10}, "the paper's B");
    visit("C", p.c, parameter::Between{-10, 10}, "the paper's C");
  }
  /// Throws InputError where B and C make no filter of the shape that sampling it takes for
  /// granted.
  void check(const PropertyReader& properties) const;
};

/* tent: 1 - |x| along both axes, of radius 1; no parameters. */
struct TentFilter {
  template <typename Self, typename Visitor>
  static void declare(Self& /*p*/, Visitor& /*visit*/) {}
};

/* box: constant over the pixel; no parameters. */
struct BoxFilter {
  template <typename Self, typename Visitor>
  static void declare(Self& /*p*/, Visitor& /*visit*/) {}
};

using Filter = std::variant<GaussianFilter, MitchellFilter, TentFilter, BoxFilter>;

/// Distance from the centre beyond which the filter is 0, pixels.
[[nodiscard]] double filter_radius(const Filter& filter);

/// Value at x pixels from the centre; not normalised.
[[nodiscard]] double filter_value(const Filter& filter, double x);

/// Whether the filter is positive at its centre and changes its sign once at most on its way out,
/// which is what sampling it takes for granted.
[[nodiscard]] bool is_bell(const Filter& filter);

/// Whether the filter is negative where it ends.
[[nodiscard]] bool ends_negative(const Filter& filter);

/// "mitchell, radius 2, B 0.5, C 0.25": all there is to a filter, for people and for comparisons.
[[nodiscard]] std::string describe(const Filter& filter);

}  // namespace facet
