#include "render/pack/filter_table.h"

#include <cmath>

#include "core/error.h"

namespace facet {

namespace {

constexpr int interval_count = 1024;
/// Steps of the numerical integration, over the whole width.
constexpr int fine_count = 1 << 16;

/// Offset at which a filter that ends negative turns so; beyond its radius for one that does not.
double find_crossing(const Filter& filter, double radius) {
  double positive = 0;
  double negative = radius * (1 - 1e-6);
  if (!ends_negative(filter)) return 2 * radius;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (positive + negative);
    (filter_value(filter, middle) >= 0 ? positive : negative) = middle;
  }
  return positive;
}

}  // namespace

FilterTable make_filter_table(const Filter& filter) {
  double radius = filter_radius(filter);
  // A narrow bell within a wide radius would fall between the steps; beyond 12 deviations it has no
  // mass.
  if (const auto* bell = std::get_if<GaussianFilter>(&filter))
    radius = std::min(radius, 12 * bell->stddev);
  const double step = 2 * radius / fine_count;
  const auto offset = [&](double i) { return -radius + i * step; };
  // Borders are nudged inwards, so that a box filter is not 0 there.
  const auto value = [&](double x) { return filter_value(filter, x * (1 - 1e-12)); };
  std::vector<double> mass(fine_count + 1, 0.0);
  double integral = 0;
  for (int i = 0; i < fine_count; ++i) {
    const double middle = value(offset(i + 0.5));
    integral += middle * step;
    mass[static_cast<std::size_t>(i) + 1] =
        mass[static_cast<std::size_t>(i)] + std::abs(middle) * step;
  }
  if (!(integral > 0)) throw InputError("the reconstruction filter's integral is not positive");

  FilterTable table;
  table.crossing = static_cast<float>(find_crossing(filter, radius));
  table.scale = static_cast<float>(mass.back() / integral);
  std::size_t i = 0;
  for (int k = 0; k <= interval_count; ++k) {
    const double target = mass.back() * k / interval_count;
    while (i + 1 < fine_count && mass[i + 1] < target) ++i;
    const double within = mass[i + 1] > mass[i] ? (target - mass[i]) / (mass[i + 1] - mass[i]) : 0;
    const double x = k == interval_count ? radius : offset(static_cast<double>(i) + within);
    table.quantiles.emplace_back(static_cast<float>(x), static_cast<float>(std::abs(value(x))));
  }
  return table;
}

}  // namespace facet
