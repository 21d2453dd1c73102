#include "tradeoff/series.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/figure.h"
#include "image/film.h"
#include "statistics/hypothesis.h"

namespace facet::tradeoff {

namespace {

constexpr double confidence = 0.95;

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<double> errors_of(const Series& series, double RelativeError::*which) {
  std::vector<double> values;
  for (const RelativeError& error : series.errors) values.push_back(error.*which);
  return values;
}

/// Variance of the mean of the logarithms; infinite where they do not tell.
double log_variance(const std::vector<double>& estimates) {
  const bool has_logarithms = std::ranges::all_of(estimates, [](double v) { return v > 0; });
  if (estimates.size() < 2 || !has_logarithms) return INFINITY;
  std::vector<double> logarithms;
  logarithms.reserve(estimates.size());
  for (const double v : estimates) logarithms.push_back(std::log(v));
  const double mean = mean_of(logarithms);
  const auto n = static_cast<double>(logarithms.size());
  double variance = 0;
  for (const double v : logarithms) variance += (v - mean) * (v - mean) / (n - 1);
  return variance / n;
}

/// Around a positive quantity: Student's t over the logarithms of its estimates.
Interval interval_around(double center, const std::vector<double>& estimates) {
  const double variance = log_variance(estimates);
  if (!std::isfinite(variance)) return {0, INFINITY};
  const double t =
      statistics::student_quantile(0.5 + confidence / 2, static_cast<double>(estimates.size()) - 1);
  const double factor = std::exp(t * std::sqrt(variance));
  return {center / factor, center * factor};
}

double median_of(std::vector<double> values) { return summarise(std::move(values)).median; }

}  // namespace

void add(Series& series, const Film& film, double default_seconds, const Reference& reference) {
  series.seconds.push_back(film.record.seconds);
  series.default_seconds.push_back(default_seconds);
  series.images.push_back(develop(film, false));
  series.errors.push_back(relative_error(series.images.back(), reference));
  if (series.sum.pixels.empty()) {
    series.sum = film;
  } else {
    add_samples(series.sum, film);
  }
}

Point point_of(const Series& series, const Series& of_default, double reference_relmse) {
  // What is left of an error that the reference's own has been taken from can be less than nothing.
  const double least = std::max(0.01 * reference_relmse, 1e-30);
  Point p;
  p.samples = series.samples;
  p.seconds = summarise(series.seconds).median;
  const std::vector<double> errors = errors_of(series, &RelativeError::relmse);
  const std::vector<double> plain = errors_of(of_default, &RelativeError::relmse);
  p.at_reference = mean_of(errors) <= reference_relmse;
  p.relmse = std::max(mean_of(errors), least);
  p.relmse_trimmed = std::max(mean_of(errors_of(series, &RelativeError::trimmed)), least);
  p.interval = interval_around(p.relmse, errors);
  p.log_variance = log_variance(errors);
  const double faster = summarise(series.default_seconds).median / p.seconds;
  p.efficiency_ratio = faster * std::max(mean_of(plain), least) / p.relmse;
  const std::vector<double> plain_trimmed = errors_of(of_default, &RelativeError::trimmed);
  p.trimmed_ratio = faster * std::max(mean_of(plain_trimmed), least) / p.relmse_trimmed;
  // The same seeds: what makes the one's image bad may have made the other's.
  std::vector<double> ratios;
  for (std::size_t k = 0; k < std::min(errors.size(), plain.size()); ++k)
    ratios.push_back(plain[k] / errors[k]);
  p.ratio_interval = interval_around(p.efficiency_ratio, ratios);
  return p;
}

void expect(const std::vector<Point*>& points) {
  /// Variance, from setting to setting, of the logarithm of what trimming takes away.
  constexpr double variance_of_tails = 0.05;
  std::vector<double> tails;
  std::vector<double> variances;
  for (const Point* p : points) {
    tails.push_back(std::log(p->relmse / p->relmse_trimmed));
    variances.push_back(p->log_variance);
  }
  for (Point* p : points) {
    // Few renders can agree by chance.
    const double own_variance = std::max(p->log_variance, median_of(variances));
    const double own = std::log(p->relmse);
    const double others = std::log(p->relmse_trimmed) + median_of(tails);
    const bool is_far = own - others > 3 * std::sqrt(own_variance + variance_of_tails);
    const double weight = is_far ? 1 : 1 / (1 + own_variance / variance_of_tails);
    p->expected = std::exp(others + weight * (own - others));
    const double by_relmse = p->efficiency_ratio * p->relmse;
    const Point& plain = *points.front();
    p->expected_ratio = by_relmse / plain.relmse * plain.expected / p->expected;
  }
}

std::optional<double> slope_of(const std::vector<Point>& points) {
  std::vector<std::pair<double, double>> logarithms;
  for (const Point& p : points) {
    if (!p.at_reference) logarithms.emplace_back(std::log(p.samples), std::log(p.relmse));
  }
  if (logarithms.size() < 2) return std::nullopt;
  const auto n = static_cast<double>(logarithms.size());
  double x = 0;
  double y = 0;
  for (const auto& [px, py] : logarithms) {
    x += px / n;
    y += py / n;
  }
  double xx = 0;
  double xy = 0;
  for (const auto& [px, py] : logarithms) {
    xx += (px - x) * (px - x);
    xy += (px - x) * (py - y);
  }
  return xy / xx;
}

void mark_front(std::vector<Setting>& settings) {
  std::vector<Point*> points;
  for (Setting& setting : settings) {
    for (Point& p : setting.points) points.push_back(&p);
  }
  for (Point* p : points) {
    p->front = std::ranges::none_of(points, [&](const Point* other) {
      const bool no_worse = other->seconds <= p->seconds && other->relmse <= p->relmse;
      return no_worse && (other->seconds < p->seconds || other->relmse < p->relmse);
    });
  }
}

}  // namespace facet::tradeoff
