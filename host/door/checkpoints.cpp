#include <facet/checkpoint.h>
#include <sys/resource.h>

#include <future>
#include <stdexcept>

#include "core/clock.h"
#include "core/error.h"
#include "core/parallel.h"
#include "image/files.h"
#include "image/render_state.h"
#include "parts/checkpoint.h"

namespace facet {

namespace {

/// Largest share of the time that checkpoints may take.
constexpr double largest_share = 0.01;

/// Seconds by which a checkpoint may be late for all pixels to have the same samples, which makes
/// it a part.
constexpr double patience = 1;

double thread_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Returns the seconds that it took of the processors' time.
double write_state(const RenderState& state, const std::filesystem::path& file) {
  const double start = thread_seconds();
  write_exr(file, make_checkpoint(state), ExrCompression::uncompressed);
  return (thread_seconds() - start) / static_cast<double>(thread_count());
}

/// Saves a rendering while it goes on.
class Saver {
 public:
  Saver(const Rendering& rendering, const CheckpointOptions& options)
      : rendering_(rendering), options_(options), due_(Clock::now() + duration_of(options.every)) {}

  /// To be called where the rendering's state can be looked at.
  void look() {
    if (writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
      finish();
    const Clock::time_point now = Clock::now();
    if (now < due_ || writing_.valid()) return;
    if (!rendering_.is_good_moment() && now < due_ + duration_of(patience)) return;
    auto state = std::make_unique<RenderState>(rendering_.state());
    copying_ = seconds_since(now);
    started_ = now;
    writing_ = std::async(std::launch::async, [this, state = std::move(state)] {
      return write_state(*state, options_.file);
    });
  }

  [[nodiscard]] const CheckpointCosts& costs() const { return costs_; }

  /// Waits for what is being written, and decides when to write again.
  void finish() {
    if (!writing_.valid()) return;
    double seconds = copying_;
    try {
      seconds += writing_.get();
      ++costs_.written;
    } catch (const Error& error) {
      if (options_.on_failure) options_.on_failure(error.what());
    }
    costs_.seconds += seconds;
    due_ = started_ + duration_of(std::max(options_.every, seconds / largest_share));
  }

 private:
  const Rendering& rendering_;
  const CheckpointOptions& options_;
  Clock::time_point due_;
  Clock::time_point started_;
  double copying_ = 0;  ///< seconds that the rendering waited for a copy of its state
  std::future<double> writing_;
  CheckpointCosts costs_;
};

}  // namespace

void save_checkpoint(const Rendering& rendering, const std::filesystem::path& file) {
  (void)write_state(rendering.state(), file);
}

bool resume(Rendering& rendering, const std::filesystem::path& file) {
  std::error_code unknown;
  if (!std::filesystem::exists(std::filesystem::symlink_status(file, unknown))) return false;
  const RenderState saved = read_checkpoint(file.string());
  check_continues(saved, file.string(), rendering.state());
  try {
    rendering.restore(saved);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: damaged: {}", file.string(), error.what()));
  }
  return true;
}

CheckpointCosts run_with_checkpoints(Rendering& rendering, const CheckpointOptions& options,
                                     const ProgressCallback& progress) {
  Saver saver(rendering, options);
  bool ended = false;
  rendering.run([&](double done, const RenderStatistics& statistics) {
    ended = progress && !progress(done, statistics);
    if (!ended) saver.look();
    return !ended;
  });
  saver.finish();
  const CheckpointCosts costs = saver.costs();
  if (!ended) return costs;
  const Clock::time_point start = Clock::now();
  save_checkpoint(rendering, options.file);
  return {costs.written + 1, costs.seconds + seconds_since(start)};
}

}  // namespace facet
