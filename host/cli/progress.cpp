#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include "core/print.h"
#include "core/text.h"

namespace facet::cli {

namespace {

constexpr int bar_width = 24;

double seconds_left(double done, const RenderStatistics& s) {
  return done > 0 ? s.render_seconds * (1 - done) / done : 0;
}

std::string rays_per_second(const RenderStatistics& s) {
  const auto rays = static_cast<double>(s.closest_rays + s.any_rays);
  return with_unit_prefix(s.render_seconds > 0 ? rays / s.render_seconds : 0) + "rays/s";
}

}  // namespace

Progress::Progress(bool quiet, std::function<double()> error_estimate)
    : quiet_(quiet),
      terminal_(::isatty(STDERR_FILENO) != 0),
      error_estimate_(std::move(error_estimate)) {}

void Progress::update(double done, const RenderStatistics& statistics) {
  if (quiet_) return;
  if (terminal_) {
    draw_bar(done, statistics);
  } else {
    print_line(done, statistics);
  }
}

void Progress::draw_bar(double done, const RenderStatistics& s) {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(100) && done < 1) return;
  last_ = now;
  // Estimating takes a look at every pixel: it is done less and less often.
  if (error_estimate_ && s.render_seconds > next_error_) {
    error_ = error_estimate_();
    next_error_ = 1.5 * s.render_seconds;
  }
  const int filled = static_cast<int>(done * bar_width);
  const std::string error = error_ > 0 ? fmt::format("  error {:.2g}", error_) : "";
  say("\r[{:=<{}}{: <{}}] {:3.0f} %  {}samples  {}{}  {:.0f} s left \x1b[K", "", filled, "",
      bar_width - filled, 100 * done, with_unit_prefix(static_cast<double>(s.samples)) + " ",
      rays_per_second(s), error, seconds_left(done, s));
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::print_line(double done, const RenderStatistics& s) {
  if (s.render_seconds < next_line_) return;
  next_line_ = s.render_seconds + 10;
  say("{:3.0f} %  {}  {:.0f} s left\n", 100 * done, rays_per_second(s), seconds_left(done, s));
}

void Progress::finish() {
  if (drawn_) say("\r\x1b[K");
}

}  // namespace facet::cli
