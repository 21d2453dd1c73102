#pragma once
// The models of the BSDFs in 160 bits, written from their definitions alone.
#include <optional>

#include "extremes/bsdf_inputs.h"
#include "extremes/exact.h"

namespace facet::extremes {

/// Of one pair of directions.
struct ExactValue {
  std::array<Exact, 3> f;  ///< sr^-1
  /// What an error in a channel is relative to: the value, and 10^5 times what two ulp of the
  /// cosine at the microfacet change. That changes Schlick's (1 - c)^5 by any factor beside c = 1,
  /// and Fresnel's reflectance beside the critical angle, where its slope is infinite. Of what is
  /// let through, two roundings of 1, too.
  std::array<Exact, 3> size;
  /// Squared tangent of the half vector over squared roughness: the exponent of Beckmann's
  /// distribution; 0 without a half vector.
  double exponent = 0;
  /// Largest relative change of a channel by two ulp of that cosine.
  double cosine_change = 0;
  bool refracts = false;  ///< whether the directions are on different sides
};

/// The directions are taken as they are, rounded to float as they may be; where a cosine of a
/// microfacet follows from the length of their sum, it does here. Nothing: there is no closed form.
[[nodiscard]] std::optional<ExactValue> exact_value(const BsdfCase& c,
                                                    const statistics::DirectionPair& pair);

/// ExactValue::cosine_change, of a reflectance alone where the value has no closed form.
[[nodiscard]] double change_by_cosine(const BsdfCase& c, const statistics::DirectionPair& pair);

enum class RelativeTo { value, size };

/// Sum of the changes of the value when each component of the directions is rounded to its
/// neighbour, relative to ExactValue::f or size; infinite where that vanishes, 0 without a closed
/// form.
[[nodiscard]] double change_by_rounding(const BsdfCase& c, const statistics::DirectionPair& pair,
                                        RelativeTo to);

}  // namespace facet::extremes
