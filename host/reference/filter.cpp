#include "reference/filter.h"

#include <algorithm>
#include <array>

namespace facet::reference {

namespace {

constexpr int interval_count = 1024;
constexpr int panel_count = 4096;

/// Integral of |f| over [a, b] by Gauss and Legendre's five points.
double mass_between(const Filter& filter, double a, double b) {
  constexpr std::array nodes{0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array weights{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double middle = (a + b) / 2;
  const double half = (b - a) / 2;
  double sum = weights[0] * std::abs(filter_value(filter, middle));
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    sum += weights[i] * (std::abs(filter_value(filter, middle - half * nodes[i])) +
                         std::abs(filter_value(filter, middle + half * nodes[i])));
  }
  return sum * half;
}

/// The x in [a, b] up to which a panel holds the given mass.
double invert(const Filter& filter, double a, double b, double mass) {
  double low = a;
  double high = b;
  for (int i = 0; i < 60; ++i) {
    const double x = (low + high) / 2;
    (mass_between(filter, a, x) < mass ? low : high) = x;
  }
  return (low + high) / 2;
}

/// Where a filter that has negative outer lobes passes through 0; beyond the width for one that has
/// none.
double crossing_of(const Filter& filter, double width) {
  double outside = width * (1 - 1e-6);
  if (filter_value(filter, outside) >= 0) return 2 * width;
  double inside = 0;
  for (int i = 0; i < 100; ++i) {
    const double x = (inside + outside) / 2;
    (filter_value(filter, x) < 0 ? outside : inside) = x;
  }
  return outside;
}

}  // namespace

FilterProfile::FilterProfile(const Filter& filter) {
  double width = filter_radius(filter);
  if (const auto* bell = std::get_if<GaussianFilter>(&filter))
    width = std::min(width, 12 * bell->stddev);
  const double crossing = crossing_of(filter, width);
  crossing_ = static_cast<float>(crossing);

  // Panels end where f changes its sign, so that |f| is smooth within each.
  std::vector<double> borders;
  for (int i = 0; i <= panel_count; ++i) borders.push_back(width * (2.0 * i / panel_count - 1));
  if (crossing < width) {
    borders.insert(borders.end(), {-crossing, crossing});
    std::sort(borders.begin(), borders.end());
  }
  std::vector<double> below{0};
  double integral = 0;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const double mass = mass_between(filter, borders[i], borders[i + 1]);
    below.push_back(below.back() + mass);
    integral += filter_value(filter, (borders[i] + borders[i + 1]) / 2) < 0 ? -mass : mass;
  }
  ratio_ = static_cast<float>(below.back() / integral);

  for (int k = 0; k <= interval_count; ++k) {
    const double target = below.back() * k / interval_count;
    const auto next = std::upper_bound(below.begin() + 1, below.end() - 1, target);
    const auto i = static_cast<std::size_t>(next - below.begin()) - 1;
    double x = invert(filter, borders[i], borders[i + 1], target - below[i]);
    if (k == 0) x = -width;
    if (k == interval_count) x = width;
    offsets_.push_back(static_cast<float>(x));
    heights_.push_back(static_cast<float>(std::abs(filter_value(filter, x * (1 - 1e-12)))));
  }
}

}  // namespace facet::reference
