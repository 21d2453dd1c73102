#pragma once
// What a render has come to: all that it takes to continue it with not a bit different.
#include <facet/film.h>

#include <utility>

namespace facet {

/// A value of 32 bits for each pixel of a film, row by row; what it means is its maker's business.
using WordPlane = std::vector<std::uint32_t>;

/// Where a render stands in its plan (convergence/sampling_plan.h). Samples are counted from the
/// first that is rendered.
struct SamplingState {
  enum class Stage : std::uint32_t { first_half_of_pilot, second_half_of_pilot, image };

  Stage stage = Stage::image;
  std::uint32_t pilot = 0;   ///< samples a pixel of the pilot that is being rendered
  std::uint32_t spent = 0;   ///< of a pilot, beside those of the image
  std::uint32_t done = 0;    ///< of each pixel of the image, before the present round; on average
  std::uint32_t more = 0;    ///< of the present round; 0: between rounds
  std::uint32_t least = 0;   ///< those that all pixels of an adaptive render have in common
  double wanted = 0;         ///< that the error will be small enough with; 0: unknown
  std::uint32_t task = 0;    ///< of the present round or half of a pilot
  std::uint32_t sample = 0;  ///< of the task: those before it are done
  std::uint32_t length = 0;  ///< samples from there on that are being added pixel by pixel
  std::uint32_t pixel = 0;   ///< of the task's list: those before it have them

  // Of adaptive renders, a value a pixel, or empty.
  std::vector<std::uint32_t> counts;  ///< samples of each pixel, before the present round
  std::vector<double> wishes;         ///< what the pilot says (Allocation)
  std::vector<PixelSums> first_half;  ///< of a pilot

  /// Samples that every pixel of the image has, unless pixels get different numbers of them.
  [[nodiscard]] std::uint32_t whole_samples() const {
    if (stage != Stage::image || more == 0) return done;
    // The first task of a round is the image's; all others follow it.
    return done + (task == 0 ? sample : more);
  }

  /// All pixels have the samples that were being added.
  void end_step() {
    sample += std::exchange(length, 0);
    pixel = 0;
  }

  bool operator==(const SamplingState&) const = default;
};

struct RenderState {
  /// Of the image. The samples of its record are those that every pixel has; StoppedBy::interrupt
  /// where some pixels have more than others.
  Film film;
  SamplingState plan;
  /// The sums as their maker keeps them: of the image, and of samples that are no part of it.
  std::vector<WordPlane> image;
  std::vector<WordPlane> trial;
  RenderStatistics statistics;
  // What the plan depends on beside the record.
  std::uint32_t first = 0;      ///< sample
  std::uint32_t most = 0;       ///< samples of a pixel
  bool timed = false;           ///< it ends at some time
  std::optional<double> error;  ///< that is enough
  bool probes = false;          ///< some pixels get a second estimate
};

}  // namespace facet
