#pragma once
// Which samples are rendered, in which order, and when there are enough
// (docs/reference/sampling.md, "How many samples").
#include <facet/film.h>

#include <chrono>
#include <optional>
#include <vector>

#include "convergence/allocation.h"
#include "convergence/pace.h"
#include "image/render_state.h"

namespace facet {

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
  [[nodiscard]] std::size_t pixels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

/// Pixels of a film, in ascending order.
using PixelList = std::vector<std::uint32_t>;

/// Samples of some pixels, of the image or of what is no part of it.
struct SamplingTask {
  enum class Sums { image, trial };

  Sums sums = Sums::image;
  PixelList pixels;  ///< empty: all
  SampleRange samples;
  std::uint32_t seed = 0;  ///< of the samples' numbers
};

/// Who renders samples, and adds them to sums.
class SampleSource {
 public:
  using Sums = SamplingTask::Sums;

  SampleSource() = default;
  virtual ~SampleSource() = default;
  SampleSource(const SampleSource&) = delete;
  SampleSource& operator=(const SampleSource&) = delete;

  /// Adds the task's samples, of its pixels from the next-th on: some pixels get all of them, then
  /// others. `next` follows before the caller's progress is told; returns whether to go on.
  virtual bool add(const SamplingTask& task, std::uint32_t& next) = 0;
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

/// The way to a goal, which can be left and taken up again at any step.
class SamplingPlan {
 public:
  explicit SamplingPlan(const SamplingGoal& goal);

  /// Renders until the goal is met. After an interrupt the outcome's samples are those that there
  /// were to be, or, where their number was open, those that every pixel has.
  [[nodiscard]] SamplingOutcome run(SampleSource& source);

  /// Where it stands: within run(), whenever the source tells the progress.
  [[nodiscard]] SamplingState state() const;
  /// Takes the state of another plan with this goal, whose source's sums are there again. Throws
  /// std::invalid_argument for one that cannot be.
  void restore(const SamplingState& state);

  /// The samples that every pixel of the image has; of an adaptive render, on average and before
  /// the present round.
  [[nodiscard]] SampleRange whole_samples() const;
  /// Whether some pixels have samples beyond those.
  [[nodiscard]] bool is_uneven() const;
  /// As Rendering::is_good_moment.
  [[nodiscard]] bool is_good_moment() const { return goal_.adaptive || !is_uneven(); }

 private:
  /// Whether all pixels of the present step have its samples.
  [[nodiscard]] bool step_is_done() const {
    return state_.length > 0 && state_.pixel == pixels_of_task_;
  }
  [[nodiscard]] std::uint32_t next_round(SampleSource& source);
  /// Half of a pilot.
  [[nodiscard]] SamplingTask pilot_task() const;
  /// counts: of samples that each pixel will have, where they differ.
  [[nodiscard]] std::vector<SamplingTask> tasks_of_round(
      const std::vector<std::uint32_t>& counts) const;
  void add_steps(std::vector<SamplingTask>& tasks, SamplingTask::Sums sums, PixelList pixels,
                 const std::vector<std::uint32_t>& counts, std::uint32_t seed) const;
  [[nodiscard]] std::vector<std::uint32_t> counts_of_round() const;
  bool run_tasks(SampleSource& source, const std::vector<SamplingTask>& tasks);
  bool run_task(SampleSource& source, const SamplingTask& task);
  bool run_pilot(SampleSource& source);
  [[nodiscard]] bool begin_pilot(SampleSource& source);
  void end_round(std::vector<std::uint32_t> counts);
  [[nodiscard]] bool is_good_enough(const SampleSource& source);
  void tell_expectations(SampleSource& source) const;
  void expect(SampleSource& source, double samples) const;
  [[nodiscard]] SamplingOutcome outcome(StoppedBy reason) const;

  SamplingGoal goal_;
  PixelList probes_;
  std::uint32_t most_;
  std::optional<Pace> pace_;        ///< while it runs
  std::size_t pixels_of_task_ = 0;  ///< the present one
  std::optional<Allocation> allocation_;
  SamplingState state_;
};

/// A state that holds the plan's and its goal's share.
[[nodiscard]] RenderState state_of(const SamplingPlan& plan, const SamplingGoal& goal);

/// Adds what another render has counted, and its seconds.
void add_counts(RenderStatistics& statistics, const RenderStatistics& more);

/// The film of the image so far, with its probes; while there is none yet, that of the pilot.
[[nodiscard]] Film film_of(const SamplingGoal& goal, const SampleSource& source);

}  // namespace facet
