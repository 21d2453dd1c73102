#pragma once
// Which setting reaches a wanted error soonest.
#include <optional>
#include <string>

#include "tradeoff/tradeoff.h"

namespace facet::tradeoff {

struct Advice {
  std::size_t setting = 0;
  double samples = 0;    ///< a pixel
  double seconds = 0;    ///< of a render of the wanted size, starting included
  bool measured = true;  ///< within the numbers of samples that were measured, not beyond
};

/// Samples a pixel by which the points' expected relmse is at most `relmse`: between them along the
/// straight line of logarithms; beyond them by the slope that the last two have, but no steeper
/// than independent samples have, and no flatter than their root.
[[nodiscard]] double samples_for(const std::vector<Point>& points, double relmse);

/// Of the settings without bias, that which renders the image, of the size that was asked for or of
/// the scene, to the relative error (the root of relmse) soonest. Nothing where none was measured.
[[nodiscard]] std::optional<Advice> advise(const Tradeoff& tradeoff, double error);

/// A biased setting that gets there sooner than the advice, although its bias adds to the error;
/// nothing where there is none.
[[nodiscard]] std::optional<Advice> advise_biased(const Tradeoff& tradeoff, double error,
                                                  const Advice& advice);

/// `facet render` with the setting's options and these beside.
[[nodiscard]] std::string command_of(const Tradeoff& tradeoff, const Setting& setting,
                                     const std::string& more);
/// The one that makes the first of the images that a point was measured by.
[[nodiscard]] std::string command_of(const Tradeoff& tradeoff, const Setting& setting,
                                     std::uint32_t samples);

}  // namespace facet::tradeoff
