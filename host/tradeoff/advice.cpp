#include "tradeoff/advice.h"

#include <algorithm>
#include <cmath>

#include "image/rerun.h"

namespace facet::tradeoff {

namespace {

/// n where a line through (n0, e0) of a slope between logarithms comes to the error e.
double along(double n0, double e0, double slope, double e) {
  return n0 * std::pow(e / e0, 1 / slope);
}

double slope_between(const Point& a, const Point& b) {
  return std::log(b.expected / a.expected) / std::log(static_cast<double>(b.samples) / a.samples);
}

/// How the setting would do, the image's error beside the bias being at most the root of `relmse`.
Advice advice_for(const Tradeoff& tradeoff, std::size_t index, double relmse) {
  const Setting& setting = tradeoff.settings[index];
  const std::vector<Point>& points = setting.points;
  const double least = setting.plan.request.adaptive ? least_adaptive_samples : 1;
  Advice advice;
  advice.setting = index;
  advice.samples = std::max(least, std::ceil(samples_for(points, relmse)));
  advice.measured = advice.samples <= 1.5 * points.back().samples;
  const auto pixels = [](const ImageSize& size) {
    return static_cast<double>(size.width) * size.height;
  };
  const double per_sample = points.back().seconds / points.back().samples *
                            pixels(tradeoff.own_size) / pixels(tradeoff.size);
  advice.seconds = tradeoff.startup_seconds + per_sample * advice.samples;
  return advice;
}

template <typename Accept>
std::optional<Advice> soonest(const Tradeoff& tradeoff, double error, const Accept& accept) {
  std::optional<Advice> best;
  for (std::size_t i = 0; i < tradeoff.settings.size(); ++i) {
    const Setting& setting = tradeoff.settings[i];
    // Kernels on the device are what is chosen for; the reference is there to check them.
    if (!accept(setting) || setting.plan.reference) continue;
    const Advice advice = advice_for(tradeoff, i, error * error);
    if (!best || advice.seconds < best->seconds) best = advice;
  }
  return best;
}

}  // namespace

double samples_for(const std::vector<Point>& points, double relmse) {
  const Point& first = points.front();
  if (points.size() == 1) return along(first.samples, first.expected, -1, relmse);
  if (relmse >= first.expected) {
    const double slope = std::clamp(slope_between(first, points[1]), -2.0, -0.5);
    return along(first.samples, first.expected, slope, relmse);
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Point& a = points[i];
    const Point& b = points[i + 1];
    if (relmse < b.expected || b.expected >= a.expected) continue;
    return along(a.samples, a.expected, slope_between(a, b), relmse);
  }
  const Point& last = points.back();
  const double slope = std::clamp(slope_between(points[points.size() - 2], last), -1.0, -0.5);
  return std::max<double>(last.samples, along(last.samples, last.expected, slope, relmse));
}

std::optional<Advice> advise(const Tradeoff& tradeoff, double error) {
  return soonest(tradeoff, error, [](const Setting& setting) { return !setting.biased; });
}

std::optional<Advice> advise_biased(const Tradeoff& tradeoff, double error, const Advice& advice) {
  // The points' errors hold the bias already.
  const auto found = soonest(tradeoff, error, [&](const Setting& setting) {
    return setting.biased && setting.bias < error / 2;
  });
  return found && found->seconds < 0.9 * advice.seconds ? found : std::nullopt;
}

std::string command_of(const Tradeoff& tradeoff, const Setting& setting, const std::string& more) {
  // A name may begin with a minus.
  const std::string place = tradeoff.scene.starts_with('-') ? "./" : "";
  std::string command = "facet render " + shell_word(place + tradeoff.scene);
  for (const std::string& word : setting.options) command += ' ' + shell_word(word);
  return command + more;
}

std::string command_of(const Tradeoff& tradeoff, const Setting& setting, std::uint32_t samples) {
  std::string more = fmt::format(" --spp {} --resolution {}x{}", samples, tradeoff.size.width,
                                 tradeoff.size.height);
  if (const auto& crop = setting.plan.request.crop)
    more += fmt::format(" --crop {},{},{},{}", crop->x0, crop->y0, crop->x1, crop->y1);
  if (const auto& seed = setting.plan.request.seed) more += fmt::format(" --seed {}", *seed);
  return command_of(tradeoff, setting, more);
}

}  // namespace facet::tradeoff
