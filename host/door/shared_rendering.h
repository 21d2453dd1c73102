#pragma once
// One render that several backends share.
#include <condition_variable>
#include <deque>
#include <mutex>

#include "core/clock.h"
#include "door/film_tree.h"
#include "scene/testable_backend.h"

namespace facet {

/// Whether a device that needs so many seconds for a share should start one of those left: not
/// where the others, which need so many each, would have done all of them sooner.
[[nodiscard]] bool is_worth_starting(double own_seconds, const std::vector<double>& others_seconds,
                                     std::size_t left);

/// See share_renders (door/shared_backend.h).
class SharedRendering : public Rendering {
 public:
  /// remarks: gets what a caller should know. It and the backends must outlive this.
  SharedRendering(const std::vector<std::unique_ptr<TestableBackend>>& backends, ScenePtr scene,
                  const RenderSettings& settings, std::vector<std::string>& remarks);

  void run(const ProgressCallback& progress) override;
  std::vector<Radiance> sample(std::uint32_t index) override;
  [[nodiscard]] RenderRecord record() const override;
  [[nodiscard]] Film film() const override;
  [[nodiscard]] const RenderStatistics& statistics() const override { return statistics_; }
  [[nodiscard]] RenderState state() const override;
  [[nodiscard]] bool is_good_moment() const override { return false; }
  void restore(const RenderState& state) override;

 private:
  /// One of the backends, and what it has done of a render.
  struct Worker {
    TestableBackend* backend = nullptr;
    double share_seconds = 0;   ///< that a share takes it, as measured; 0: not known yet
    std::optional<Film> first;  ///< of the first sample
    RenderStatistics done;      ///< of its shares so far
    RenderStatistics now;       ///< of the share that it is at
    bool has_left = false;      ///< it renders no more

    [[nodiscard]] std::string name() const {
      return fmt::format("{} ({})", backend->name(), backend->driver());
    }
  };

  /// Has all threads end soon, unless they have done everything.
  void stop();
  /// Whether all shares are rendered.
  [[nodiscard]] bool is_done() const;

  // Of a worker's thread.
  void work(Worker& worker);
  /// Renders the samples, and measures for how long. counts: they are of the image.
  Film render(Worker& worker, const RenderSettings& settings, bool counts);
  /// The next share to render; none where the others do the rest sooner, or nothing is left.
  std::optional<std::uint32_t> next_share(const Worker& worker);
  [[nodiscard]] bool is_wanted(const Worker& worker) const;
  void finish(std::uint32_t share, Film film);
  /// Called from a handler. A device's failure leaves the share to the others while there are any.
  void fail(Worker& worker, const std::optional<std::uint32_t>& share, bool is_device,
            const std::string& message);

  // Of the caller's thread.
  void tell_progress(const ProgressCallback& progress);
  [[nodiscard]] RenderStatistics statistics_so_far() const;
  /// Devices that round otherwise make the image depend on who rendered what.
  void tell_differences();

  ScenePtr scene_;
  RenderSettings settings_;
  std::vector<std::string>& remarks_;
  std::uint32_t shares_;
  std::deque<Worker> workers_;
  RenderStatistics statistics_;
  Clock::time_point start_;

  mutable std::mutex mutex_;  ///< of what follows, and of the workers
  std::condition_variable changed_;
  std::deque<std::uint32_t> left_;  ///< shares that nobody renders yet, in order
  std::size_t at_work_ = 0;         ///< workers that render a share
  bool stopped_ = false;
  std::exception_ptr failure_;
  FilmTree films_;
};

}  // namespace facet
