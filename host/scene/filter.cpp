#include "scene/filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/xml/property_reader.h"

namespace facet {

namespace {

double value(const GaussianFilter& f, double x) {
  const double k = -0.5 / (f.stddev * f.stddev);
  return std::max(0.0, std::exp(k * x * x) - std::exp(k * f.radius * f.radius));
}

double value(const MitchellFilter& f, double x) {
  const double t = 2 * std::abs(x) / f.radius;
  if (t < 1) {
    return ((12 - 9 * f.b - 6 * f.c) * t * t * t + (-18 + 12 * f.b + 6 * f.c) * t * t +
            (6 - 2 * f.b)) /
           6;
  }
  // In factors, so that its sign is right up to the end.
  const double left = 2 - t;
  return left > 0 ? left * left * (f.b * left - 6 * f.c * (t - 1)) / 6 : 0;
}

double value(const TentFilter&, double x) { return std::max(0.0, 1 - std::abs(x)); }
double value(const BoxFilter&, double x) { return std::abs(x) <= 0.5 ? 1 : 0; }

double radius(const GaussianFilter& f) { return f.radius; }
double radius(const MitchellFilter& f) { return f.radius; }
double radius(const TentFilter&) { return 1; }
double radius(const BoxFilter&) { return 0.5; }

std::string text(const GaussianFilter& f) {
  return fmt::format("gaussian, radius {}, stddev {}", f.radius, f.stddev);
}
std::string text(const MitchellFilter& f) {
  return fmt::format("mitchell, radius {}, B {}, C {}", f.radius, f.b, f.c);
}
std::string text(const TentFilter&) { return "tent"; }
std::string text(const BoxFilter&) { return "box"; }

}  // namespace

void MitchellFilter::check(const PropertyReader& properties) const {
  if (is_bell(*this)) return;
  properties.fail(
      "C", fmt::format("with B = {} and C = {} the filter is not positive first and negative "
                       "beyond; B from 0 to 1 and C from 0 to 1 are usual",
                       b, c));
}

double filter_radius(const Filter& filter) {
  return std::visit([](const auto& f) { return radius(f); }, filter);
}

double filter_value(const Filter& filter, double x) {
  return std::visit([x](const auto& f) { return value(f, x); }, filter);
}

bool is_bell(const Filter& filter) {
  constexpr int steps = 4096;
  bool negative = false;
  double integral = 0;
  for (int i = 0; i < steps; ++i) {
    const double v = filter_value(filter, filter_radius(filter) * (i + 0.5) / steps);
    if (negative && v > 0) return false;
    negative = negative || v < 0;
    integral += v;
  }
  return integral > 0;
}

bool ends_negative(const Filter& filter) {
  return filter_value(filter, filter_radius(filter) * (1 - 1e-6)) < 0;
}

std::string describe(const Filter& filter) {
  return std::visit([](const auto& f) { return text(f); }, filter);
}

}  // namespace facet
