#include "door/shared_rendering.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <thread>

#include "convergence/sampling_plan.h"
#include "core/error.h"
#include "core/memory.h"
#include "image/division.h"
#include "image/film.h"
#include "image/record.h"

namespace facet {

namespace {

constexpr std::uint32_t most_shares_of_devices = 32;
constexpr const char* no_state = "a render that several devices share has no state";

/// In how many pixels two films of one sample a pixel differ in any bit.
std::size_t differing_pixels(const Film& a, const Film& b) {
  using Bits = std::array<std::uint64_t, 3>;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    if (std::bit_cast<Bits>(a.pixels[i].values) != std::bit_cast<Bits>(b.pixels[i].values)) ++count;
  }
  return count;
}

/// Adds what was counted and what it took; seconds of rendering are left aside.
void add_work(RenderStatistics& sum, const RenderStatistics& more) {
  add_counts(sum, more);
  sum.bvh_seconds += more.bvh_seconds;
  sum.compile_seconds += more.compile_seconds;
  sum.device_bytes = std::max(sum.device_bytes, more.device_bytes);
  sum.kernel_instructions = std::max(sum.kernel_instructions, more.kernel_instructions);
  if (sum.features.empty()) sum.features = more.features;
}

}  // namespace

bool is_worth_starting(double own_seconds, const std::vector<double>& others_seconds,
                       std::size_t left) {
  if (left == 0) return false;
  double others = 0;  // shares a second
  for (const double seconds : others_seconds) others += 1 / seconds;
  // Each of them has the share that it is at before it.
  return own_seconds * others <= static_cast<double>(left + others_seconds.size());
}

SharedRendering::SharedRendering(const std::vector<std::unique_ptr<TestableBackend>>& backends,
                                 ScenePtr scene, const RenderSettings& settings,
                                 std::vector<std::string>& remarks)
    : scene_(std::move(scene)),
      settings_(settings),
      remarks_(remarks),
      shares_(std::bit_floor(std::min(settings.samples_per_pixel(), most_shares_of_devices))) {
  for (const auto& backend : backends) workers_.emplace_back().backend = backend.get();
  for (std::uint32_t i = 0; i < shares_; ++i) left_.push_back(i);
  statistics_.planned = settings_.total_samples();
}

void SharedRendering::run(const ProgressCallback& progress) {
  start_ = Clock::now();
  {
    std::vector<std::jthread> threads;
    // Whatever ends this early ends the others' work, too: threads are waited for.
    const std::unique_ptr<SharedRendering, void (*)(SharedRendering*)> stop(
        this, [](SharedRendering* rendering) { rendering->stop(); });
    for (Worker& worker : workers_) {
      threads.emplace_back([this, &worker, activity = Activity::innermost()] {
        Activity::adopt(activity);
        work(worker);
      });
    }
    tell_progress(progress);
  }
  if (failure_) std::rethrow_exception(failure_);
  tell_differences();
}

void SharedRendering::stop() {
  const std::scoped_lock lock(mutex_);
  stopped_ = stopped_ || !is_done();
  changed_.notify_all();
}

bool SharedRendering::is_done() const { return left_.empty() && at_work_ == 0; }

std::vector<Radiance> SharedRendering::sample(std::uint32_t index) {
  return workers_.front().backend->start(scene_, settings_)->sample(index);
}

RenderRecord SharedRendering::record() const {
  RenderRecord record = record_of(*scene_, settings_);
  for (const Worker& worker : workers_) {
    if (!worker.first || worker.done.samples == 0) continue;
    add_items(record.backend, worker.first->record.backend);
    add_items(record.device, worker.first->record.device);
    add_items(record.driver, worker.first->record.driver);
  }
  record.seconds = statistics_.render_seconds;
  record.stopped_by = StoppedBy::interrupt;
  return record;
}

Film SharedRendering::film() const {
  const std::scoped_lock lock(mutex_);
  std::optional<Film> film = films_.sum();
  const bool has_shares = film.has_value();
  // Before the first share is done, something is better than nothing.
  for (const Worker& worker : workers_) {
    if (!film) film = worker.first;
  }
  if (!film) {
    film = make_film(settings_.crop_width(), settings_.crop_height(), settings_.window(),
                     settings_.variance);
    // Without one, the first is told that is lacking.
    film->record.samples.add({settings_.samples.begin, settings_.samples.begin + 1});
  }
  const SampleRanges samples = film->record.samples;
  film->record = record();
  film->record.samples = samples;
  if (has_shares && samples.missing_in(settings_.samples).empty())
    film->record.stopped_by = StoppedBy::samples;
  return *film;
}

RenderState SharedRendering::state() const { throw std::logic_error(no_state); }

void SharedRendering::restore(const RenderState& /*state*/) { throw std::logic_error(no_state); }

void SharedRendering::work(Worker& worker) {
  std::optional<std::uint32_t> share;
  try {
    RenderSettings settings = settings_;
    settings.samples.end = settings.samples.begin + 1;
    Film first = render(worker, settings, false);
    if (first.record.stopped_by == StoppedBy::samples) {
      const std::scoped_lock lock(mutex_);
      worker.first = std::move(first);
    }
    while ((share = next_share(worker))) {
      settings.samples = share_of(settings_.samples, Share{*share + 1, shares_});
      Film film = render(worker, settings, true);
      finish(*share, std::move(film));
      share.reset();
    }
  } catch (const Error& error) {
    fail(worker, share, error.kind() == ErrorKind::device, error.what());
  } catch (...) {
    fail(worker, share, false, "");
  }
  const std::scoped_lock lock(mutex_);
  worker.has_left = true;
  changed_.notify_all();
}

Film SharedRendering::render(Worker& worker, const RenderSettings& settings, bool counts) {
  const Clock::time_point start = Clock::now();
  const std::unique_ptr<Rendering> rendering = worker.backend->start(scene_, settings);
  const double start_seconds = seconds_since(start);
  rendering->run([&](double /*done*/, const RenderStatistics& statistics) {
    const std::scoped_lock lock(mutex_);
    if (counts) worker.now = statistics;
    // Nobody waits for a trial when all is rendered.
    return !stopped_ && (counts || !is_done());
  });
  Film film = rendering->film();
  const std::scoped_lock lock(mutex_);
  const double samples_of_share = static_cast<double>(settings_.samples_per_pixel()) / shares_;
  worker.share_seconds = start_seconds + (seconds_since(start) - start_seconds) * samples_of_share /
                                             settings.samples_per_pixel();
  worker.now = {};
  if (counts) add_work(worker.done, rendering->statistics());
  return film;
}

std::optional<std::uint32_t> SharedRendering::next_share(const Worker& worker) {
  std::unique_lock lock(mutex_);
  // One that is at work may fail, and its share be another's.
  changed_.wait(lock, [&] { return stopped_ || is_done() || is_wanted(worker); });
  if (stopped_ || left_.empty()) return std::nullopt;
  const std::uint32_t share = left_.front();
  left_.pop_front();
  ++at_work_;
  return share;
}

bool SharedRendering::is_wanted(const Worker& worker) const {
  std::vector<double> others;
  for (const Worker& other : workers_) {
    if (&other != &worker && !other.has_left && other.share_seconds > 0)
      others.push_back(other.share_seconds);
  }
  return is_worth_starting(worker.share_seconds, others, left_.size());
}

void SharedRendering::finish(std::uint32_t share, Film film) {
  const std::scoped_lock lock(mutex_);
  // One that was stopped lacks some of its samples.
  if (film.record.stopped_by == StoppedBy::samples) films_.add(share, std::move(film));
  --at_work_;
  changed_.notify_all();
}

void SharedRendering::fail(Worker& worker, const std::optional<std::uint32_t>& share,
                           bool is_device, const std::string& message) {
  const std::scoped_lock lock(mutex_);
  worker.has_left = true;
  if (share) {
    --at_work_;
    left_.push_front(*share);
  }
  const bool others_go_on = !std::ranges::all_of(workers_, &Worker::has_left);
  if (is_device && (others_go_on || is_done())) {
    remarks_.push_back(message + "; the other devices go on");
  } else {
    if (!failure_) failure_ = std::current_exception();
    stopped_ = true;
  }
  changed_.notify_all();
}

void SharedRendering::tell_progress(const ProgressCallback& progress) {
  constexpr std::chrono::milliseconds interval(50);
  std::unique_lock lock(mutex_);
  const auto is_over = [&] { return std::ranges::all_of(workers_, &Worker::has_left); };
  bool over = false;
  while (!over) {
    over = changed_.wait_for(lock, interval, is_over);
    statistics_ = statistics_so_far();
    const double done = static_cast<double>(statistics_.samples) /
                        static_cast<double>(std::max<std::uint64_t>(statistics_.planned, 1));
    lock.unlock();
    const bool goes_on = !progress || progress(done, statistics_);
    lock.lock();
    if (!goes_on) stopped_ = true;
    if (stopped_) changed_.notify_all();
  }
}

RenderStatistics SharedRendering::statistics_so_far() const {
  RenderStatistics sum;
  for (const Worker& worker : workers_) {
    add_work(sum, worker.done);
    add_work(sum, worker.now);
  }
  sum.planned = settings_.total_samples();
  sum.render_seconds = seconds_since(start_);
  return sum;
}

void SharedRendering::tell_differences() {
  if (stopped_) return;
  const auto one =
      std::ranges::find_if(workers_, [](const Worker& w) { return w.first.has_value(); });
  for (const Worker& other : workers_) {
    if (!other.first) continue;
    const std::size_t count = differing_pixels(*one->first, *other.first);
    if (count > 0)
      remarks_.push_back(fmt::format(
          "{} and {} compute the first sample of {} of {} pixels with other bits, so which of "
          "them rendered what shows in the image's last digits",
          one->name(), other.name(), count, one->first->pixels.size()));
  }
}

}  // namespace facet
