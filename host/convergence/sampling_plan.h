#pragma once
// Which samples are rendered, in which order, and when there are enough (docs/sampling.md, "How
// many samples").
#include <facet/film.h>

#include <chrono>
#include <optional>
#include <vector>

namespace facet {

using Clock = std::chrono::steady_clock;

/// What decides how many samples an image gets.
struct SamplingGoal {
  int width = 0;
  int height = 0;
  SampleRange samples;  ///< of each pixel; on average where adaptive; the most where open_ended()
  std::uint32_t seed = 0;
  bool adaptive = false;        ///< pixels get samples by their variance
  bool probes = false;          ///< some pixels get a second estimate
  std::optional<double> error;  ///< the relative error that is enough, with a confidence of 95 %
  std::optional<Clock::time_point> deadline;

  [[nodiscard]] bool open_ended() const { return error || deadline; }
  /// Whether there are samples that are no part of the image: a pilot's, or of probes.
  [[nodiscard]] bool has_trial() const { return adaptive || probes; }
};

/// Pixels of a film, in ascending order.
using PixelList = std::vector<std::uint32_t>;

/// Who renders samples, and adds them to sums.
class SampleSource {
 public:
  /// Those of the image, and those of samples that are no part of it, where the goal has such.
  enum class Sums { image, trial };

  SampleSource() = default;
  virtual ~SampleSource() = default;
  SampleSource(const SampleSource&) = delete;
  SampleSource& operator=(const SampleSource&) = delete;

  /// Adds samples of these pixels (nullptr: of all) with the numbers of a seed; returns whether to
  /// go on.
  virtual bool add(Sums to, const PixelList* pixels, const SampleRange& samples,
                   std::uint32_t seed) = 0;
  /// With squares where the goal needs them; without probes and record.
  [[nodiscard]] virtual Film sums(Sums of) const = 0;
  /// Makes sums zero again.
  virtual void clear(Sums which) = 0;
  /// As many samples, over all pixels and those rendered included, there will be, as far as is
  /// known.
  virtual void expect(double samples) = 0;
  [[nodiscard]] virtual Clock::time_point now() const { return Clock::now(); }
};

struct SamplingOutcome {
  StoppedBy stopped_by = StoppedBy::samples;
  SampleRange samples;    ///< of each pixel; on average where adaptive
  bool adaptive = false;  ///< the wish for it may have had no time
};

/// Renders until a goal is met. After an interrupt the outcome's samples are those that there were
/// to be, or, where their number was open, those that every pixel has.
[[nodiscard]] SamplingOutcome render_samples(const SamplingGoal& goal, SampleSource& source);

/// The film of the image so far, with its probes; while there is none yet, that of the pilot.
[[nodiscard]] Film film_of(const SamplingGoal& goal, const SampleSource& source);

}  // namespace facet
