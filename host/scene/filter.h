#pragma once
// Reconstruction filters: one-dimensional profiles, of which the image filter is the product over x
// and y.
#include <string>
#include <variant>

namespace facet {

/* gaussian: a Gaussian, shifted down to reach 0 at its radius.

   | parameter | default | meaning                    |
   |-----------|---------|----------------------------|
   | radius    | 2       | pixels, 0.01 to 100        |
   | stddev    | 0.5     | deviation, 0.01 to 100     |

   exp(-x^2/(2 stddev^2)) - exp(-radius^2/(2 stddev^2)), the product over x and y. Samples are
   spread by the filter: no pixel depends on another's. */
struct GaussianFilter {
  double radius = 2;
  double stddev = 0.5;
};

/* mitchell: the cubic filters of Mitchell and Netravali 1988, stretched to the radius.

   | parameter | default | meaning                                        |
   |-----------|---------|------------------------------------------------|
   | radius    | 2       | pixels, 0.01 to 100; in the paper 2            |
   | B, C      | 1/3     | the paper's parameters                         |

   Negative in parts: such samples are subtracted. B and C may be any for which it is positive at
   the centre, changes its sign once at most on the way out, and has a positive integral: B from 0
   to 1 with C from 0 to 1 are among them. */
struct MitchellFilter {
  double radius = 2;
  double b = 1.0 / 3;
  double c = 1.0 / 3;
};

/* tent: 1 - |x| along both axes, of radius 1; no parameters. */
struct TentFilter {};

/* box: constant over the pixel; no parameters. */
struct BoxFilter {};

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
