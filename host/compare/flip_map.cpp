#include "compare/flip_map.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "core/parallel.h"

namespace facet {

namespace {

using glm::dmat3;
using glm::dvec3;

constexpr double pi = std::numbers::pi;
constexpr std::size_t rows_per_task = 16;

/// CIE XYZ of a chromaticity with Y = 1.
dvec3 xyz_of(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

/// Linear Rec. 709 to XYZ relative to the white point D65, so that white is (1, 1, 1).
dmat3 relative_xyz_from_rgb() {
  const dmat3 primaries(xyz_of(0.64, 0.33), xyz_of(0.30, 0.60), xyz_of(0.15, 0.06));
  const dvec3 white = xyz_of(0.31271, 0.32902);
  const dvec3 amounts = glm::inverse(primaries) * white;
  dmat3 matrix;
  for (int c = 0; c < 3; ++c) matrix[c] = primaries[c] * amounts[c] / white;
  return matrix;
}

const dmat3& xyz_from_rgb() {
  static const dmat3 matrix = relative_xyz_from_rgb();
  return matrix;
}

const dmat3& rgb_from_xyz() {
  static const dmat3 matrix = glm::inverse(xyz_from_rgb());
  return matrix;
}

/// Differences of lightness and of red-green and blue-yellow, the form that YCxCz (of XYZ) and
/// L*a*b* (of its roots) share.
dvec3 opponent(const dvec3& v) { return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)}; }

dvec3 from_opponent(const dvec3& o) {
  const double y = (o.x + 16) / 116;
  return {y + o.y / 500, y, y - o.z / 200};
}

/// CIE L*a*b* of linear colour; its chroma shrunk in the dark, where colours look less colourful
/// (Hunt).
dvec3 hunt_lab(const dvec3& rgb) {
  constexpr double delta = 6.0 / 29;
  dvec3 root = xyz_from_rgb() * rgb;
  for (int c = 0; c < 3; ++c)
    root[c] = root[c] > delta * delta * delta ? std::cbrt(root[c])
                                              : root[c] / (3 * delta * delta) + 4.0 / 29;
  const dvec3 lab = opponent(root);
  return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

/// Distance in lightness plus Euclidean distance in chroma.
double hyab(const dvec3& a, const dvec3& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// The exponent that compresses large distances.
double compress(double distance) { return std::pow(distance, 0.7); }

/// A colour distance in [0, 1]: distances below 0.4 of the largest that a display can show take
/// 0.95 of the range.
double colour_difference(double distance) {
  static const double largest = compress(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})));
  const double bend = 0.4 * largest;
  const double d = compress(distance);
  const double difference =
      d < bend ? 0.95 / bend * d : 0.95 + 0.05 * (d - bend) / (largest - bend);
  return std::min(difference, 1.0);
}

/// Samples a function of the distance from the centre, in pixels.
template <typename Function>
std::vector<double> sample(int radius, const Function& f) {
  std::vector<double> kernel;
  for (int x = -radius; x <= radius; ++x) kernel.push_back(f(static_cast<double>(x)));
  return kernel;
}

double sum_of(const std::vector<double>& kernel) {
  double sum = 0;
  for (const double w : kernel) sum += w;
  return sum;
}

/// Positive weights that sum to 1 and negative ones to -1, if there are any.
std::vector<float> normalised(const std::vector<double>& kernel) {
  double positive = 0;
  double negative = 0;
  for (const double w : kernel) (w > 0 ? positive : negative) += std::abs(w);
  std::vector<float> result;
  result.reserve(kernel.size());
  for (const double w : kernel)
    result.push_back(static_cast<float>(w / (w > 0 ? positive : std::max(negative, 1e-300))));
  return result;
}

/// exp(-(pi x)^2 / b), x in degrees: a contrast sensitivity, transformed into space.
std::vector<double> sensitivity(int radius, double b, double pixels_per_degree) {
  return sample(radius, [=](double x) {
    return std::exp(-pi * pi * x * x / (b * pixels_per_degree * pixels_per_degree));
  });
}

dvec3 colour_at(const RgbPlanes& planes, std::size_t i) {
  return {planes[0][i], planes[1][i], planes[2][i]};
}

void set_colour(RgbPlanes& planes, std::size_t i, const dvec3& colour) {
  for (std::size_t c = 0; c < 3; ++c)
    planes[c][i] = static_cast<float>(colour[static_cast<int>(c)]);
}

/// A function of each pixel's colour.
template <typename Function>
RgbPlanes map_colours(const RgbPlanes& in, const Function& f) {
  const std::size_t pixels = in[0].size();
  RgbPlanes out{Plane(pixels), Plane(pixels), Plane(pixels)};
  parallel_for(pixels, 1 << 14, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) set_colour(out, i, f(colour_at(in, i)));
  });
  return out;
}

}  // namespace

// Weights a and widths b of the sensitivities, and the widths of the feature detectors, are the
// paper's (table 1, section 4.3).
FlipMap::FlipMap(int width, int height, double pixels_per_degree)
    : width_(static_cast<std::size_t>(width)), height_(static_cast<std::size_t>(height)) {
  constexpr std::array<double, 2> by_a{34.1, 13.5};
  constexpr std::array<double, 2> by_b{0.04, 0.025};
  const int radius =
      static_cast<int>(std::ceil(3 * std::sqrt(by_b[0] / (2 * pi * pi)) * pixels_per_degree));
  luminance_ = normalised(sensitivity(radius, 0.0047, pixels_per_degree));
  red_green_ = normalised(sensitivity(radius, 0.0053, pixels_per_degree));
  std::array<double, 2> volume{};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<double> kernel = sensitivity(radius, by_b[i], pixels_per_degree);
    blue_yellow_[i] = normalised(kernel);
    volume[i] = by_a[i] * std::sqrt(pi / by_b[i]) * sum_of(kernel) * sum_of(kernel);
  }
  for (std::size_t i = 0; i < 2; ++i)
    blue_yellow_weights_[i] = static_cast<float>(volume[i] / (volume[0] + volume[1]));

  const double sigma = 0.5 * 0.082 * pixels_per_degree;
  const int feature_radius = static_cast<int>(std::ceil(3 * sigma));
  const auto gaussian = [sigma](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
  smooth_ = normalised(sample(feature_radius, gaussian));
  edge_ = normalised(sample(feature_radius, [&](double x) { return -x * gaussian(x); }));
  point_ = normalised(sample(
      feature_radius, [&](double x) { return (x * x / (sigma * sigma) - 1) * gaussian(x); }));
}

/// Convolution with an outer product of kernels; the border's pixels go on outside.
Plane FlipMap::filter(const Plane& plane, const Kernel& horizontal, const Kernel& vertical) const {
  Plane rows(plane.size());
  Plane result(plane.size());
  const std::size_t radius_x = horizontal.size() / 2;
  const std::size_t radius_y = vertical.size() / 2;
  parallel_for(height_, rows_per_task, [&](std::size_t begin, std::size_t end) {
    Plane padded(width_ + 2 * radius_x);
    for (std::size_t y = begin; y < end; ++y) {
      const float* in = plane.data() + y * width_;
      std::fill_n(padded.begin(), radius_x, in[0]);
      std::copy_n(in, width_, padded.begin() + static_cast<std::ptrdiff_t>(radius_x));
      std::fill_n(padded.rbegin(), radius_x, in[width_ - 1]);
      float* out = rows.data() + y * width_;
      for (std::size_t k = 0; k < horizontal.size(); ++k) {
        for (std::size_t x = 0; x < width_; ++x) out[x] += horizontal[k] * padded[x + k];
      }
    }
  });
  parallel_for(height_, rows_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      float* out = result.data() + y * width_;
      for (std::size_t k = 0; k < vertical.size(); ++k) {
        const std::size_t row = std::clamp(y + k, radius_y, height_ - 1 + radius_y) - radius_y;
        const float* in = rows.data() + row * width_;
        for (std::size_t x = 0; x < width_; ++x) out[x] += vertical[k] * in[x];
      }
    }
  });
  return result;
}

Plane FlipMap::length_of_gradient(const Plane& plane, const Kernel& derivative) const {
  Plane x = filter(plane, derivative, smooth_);
  const Plane y = filter(plane, smooth_, derivative);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::hypot(x[i], y[i]);
  return x;
}

RgbPlanes FlipMap::to_opponent(const RgbPlanes& rgb) const {
  return map_colours(rgb, [](const dvec3& c) { return opponent(xyz_from_rgb() * c); });
}

/// What is left of the colours at this distance, in Hunt-adjusted L*a*b*.
RgbPlanes FlipMap::to_perceived(const RgbPlanes& planes) const {
  RgbPlanes filtered{filter(planes[0], luminance_, luminance_),
                     filter(planes[1], red_green_, red_green_),
                     filter(planes[2], blue_yellow_[0], blue_yellow_[0])};
  const Plane narrow = filter(planes[2], blue_yellow_[1], blue_yellow_[1]);
  for (std::size_t i = 0; i < narrow.size(); ++i)
    filtered[2][i] = blue_yellow_weights_[0] * filtered[2][i] + blue_yellow_weights_[1] * narrow[i];
  return map_colours(filtered, [](const dvec3& o) {
    return hunt_lab(glm::clamp(rgb_from_xyz() * from_opponent(o), dvec3(0), dvec3(1)));
  });
}

/// luminance: the first opponent plane.
FlipMap::Features FlipMap::find_features(const Plane& luminance) const {
  Plane normalised(luminance.size());
  std::transform(luminance.begin(), luminance.end(), normalised.begin(),
                 [](float y) { return (y + 16) / 116; });
  return {length_of_gradient(normalised, edge_), length_of_gradient(normalised, point_)};
}

Plane FlipMap::compare(const RgbPlanes& a, const RgbPlanes& b) const {
  const RgbPlanes opponent_a = to_opponent(a);
  const RgbPlanes opponent_b = to_opponent(b);
  const RgbPlanes perceived_a = to_perceived(opponent_a);
  const RgbPlanes perceived_b = to_perceived(opponent_b);
  const Features features_a = find_features(opponent_a[0]);
  const Features features_b = find_features(opponent_b[0]);
  Plane result(width_ * height_);
  parallel_for(result.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double colour =
          colour_difference(hyab(colour_at(perceived_a, i), colour_at(perceived_b, i)));
      const double feature = std::max(std::abs(features_a.edges[i] - features_b.edges[i]),
                                      std::abs(features_a.points[i] - features_b.points[i]));
      const double exponent = 1 - std::sqrt(std::min(feature * std::numbers::sqrt2 / 2, 1.0));
      result[i] = static_cast<float>(std::pow(colour, exponent));
    }
  });
  return result;
}

}  // namespace facet
