#include "compare/metrics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "core/error.h"

namespace facet {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Planes = std::array<const float*, 3>;

std::string describe_frame(const Image& image) {
  const ImageWindow& w = image.window;
  std::string text = fmt::format("{}x{}", image.width(), image.height());
  if (w.x != 0 || w.y != 0 || w.full_width != image.width() || w.full_height != image.height())
    text += fmt::format(" at ({}, {}) of {}x{}", w.x, w.y, w.full_width, w.full_height);
  return text;
}

bool is_finite(const Planes& planes, std::size_t i) {
  return std::all_of(planes.begin(), planes.end(),
                     [i](const float* p) { return std::isfinite(p[i]); });
}

bool is_identical(const Planes& a, const Planes& b, std::size_t i) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (std::bit_cast<std::uint32_t>(a[c][i]) != std::bit_cast<std::uint32_t>(b[c][i]))
      return false;
  }
  return true;
}

double mean_luminance(const Planes& planes, std::size_t pixels) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!is_finite(planes, i)) continue;
    sum += luminance(glm::dvec3(planes[0][i], planes[1][i], planes[2][i]));
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

/// Gathers the errors pixel by pixel.
class Measurement {
 public:
  Measurement(const Image& image, const Image& reference, double tolerance)
      : a_(rgb_planes(image)),
        r_(rgb_planes(reference)),
        width_(image.width()),
        tolerance_(tolerance) {
    m_.pixels = static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
    m_.mean_luminance = mean_luminance(r_, m_.pixels);
    m_.terms.reserve(m_.pixels);
  }

  ErrorMetrics run() {
    for (std::size_t i = 0; i < m_.pixels; ++i) add_pixel(i);
    finish();
    return std::move(m_);
  }

 private:
  void add_pixel(std::size_t i) {
    if (is_identical(a_, r_, i)) ++m_.identical;
    const bool finite_a = is_finite(a_, i);
    const bool finite_r = is_finite(r_, i);
    if (!finite_a) ++m_.nonfinite_image;
    if (!finite_r) ++m_.nonfinite_reference;
    if (finite_a && finite_r) {
      add_finite_pixel(i);
    } else {
      ++m_.nonfinite;
      ++m_.beyond;
      m_.terms.push_back(nan);
    }
  }

  void add_finite_pixel(std::size_t i) {
    double term = 0;
    bool beyond = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const double r = r_[c][i];
      const double difference = std::abs(a_[c][i] - r);
      m_.mean_image[static_cast<int>(c)] += a_[c][i];
      m_.mean_reference[static_cast<int>(c)] += r;
      if (difference > m_.max_abs) {
        m_.max_abs = difference;
        m_.max_abs_x = static_cast<int>(i % static_cast<std::size_t>(width_));
        m_.max_abs_y = static_cast<int>(i / static_cast<std::size_t>(width_));
      }
      squares_ += difference * difference;
      if (difference > 0) term += difference * difference / (r * r + m_.epsilon());
      beyond =
          beyond || difference > tolerance_ * (std::abs(r) + 0.01 * std::abs(m_.mean_luminance));
    }
    if (beyond) ++m_.beyond;
    m_.terms.push_back(term / 3);
  }

  void finish() {
    std::vector<double> sorted;
    std::copy_if(m_.terms.begin(), m_.terms.end(), std::back_inserter(sorted),
                 [](double t) { return !std::isnan(t); });
    const auto count = static_cast<double>(sorted.size());
    m_.mean_image /= count;
    m_.mean_reference /= count;
    if (sorted.empty()) {
      m_.max_abs = m_.rmse = m_.relmse = m_.relmse_trimmed = nan;
      return;
    }
    m_.rmse = std::sqrt(squares_ / (3 * count));
    m_.relmse = std::accumulate(sorted.begin(), sorted.end(), 0.0) / count;
    m_.trimmed = std::min((sorted.size() + 999) / 1000, sorted.size() - 1);
    const auto kept = sorted.end() - static_cast<std::ptrdiff_t>(m_.trimmed);
    std::nth_element(sorted.begin(), kept, sorted.end());
    m_.relmse_trimmed =
        std::accumulate(sorted.begin(), kept, 0.0) / (count - static_cast<double>(m_.trimmed));
  }

  Planes a_;
  Planes r_;
  int width_;
  double tolerance_;
  double squares_ = 0;
  ErrorMetrics m_;
};

}  // namespace

std::array<const float*, 3> rgb_planes(const Image& image) {
  Planes planes{};
  constexpr std::array<const char*, 3> names{"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    const int channel = image.find_channel(names[c]);
    if (channel < 0) throw InputError(fmt::format("an image without channel {}", names[c]));
    planes[c] = image.plane(channel);
  }
  return planes;
}

void check_comparable(const Image& a, const std::string& name_a, const Image& b,
                      const std::string& name_b) {
  for (const auto& [image, name] : {std::pair(&a, &name_a), std::pair(&b, &name_b)}) {
    for (const char* channel : {"R", "G", "B"}) {
      if (image->find_channel(channel) < 0)
        throw InputError(
            fmt::format("{}: has no channel {}; R, G and B are compared", *name, channel));
    }
  }
  const std::string frame_a = describe_frame(a);
  const std::string frame_b = describe_frame(b);
  if (frame_a != frame_b) {
    throw InputError(fmt::format("{} is {} pixels, {} is {}: only like regions can be compared",
                                 name_a, frame_a, name_b, frame_b));
  }
}

double ErrorMetrics::mean_change() const {
  const glm::dvec3 ratios = mean_ratios();
  double largest = 0;
  for (int c = 0; c < 3; ++c) {
    const double change = std::abs(ratios[c] - 1);
    // NaN is beyond every bound.
    if (!(change <= largest)) largest = change;
  }
  return largest;
}

ErrorMetrics measure_errors(const Image& image, const Image& reference, double tolerance) {
  check_comparable(image, "the image", reference, "the reference");
  return Measurement(image, reference, tolerance).run();
}

std::vector<std::size_t> worst_pixels(const ErrorMetrics& metrics, std::size_t count) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < metrics.terms.size(); ++i) {
    if (metrics.terms[i] != 0) order.push_back(i);
  }
  const auto badness = [&](std::size_t i) {
    const double t = metrics.terms[i];
    // NaN is worse than infinity, which is worse than any number; equal ones keep their order.
    return std::pair(std::isnan(t) ? 1 : 0, std::isnan(t) ? 0 : t);
  };
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(count, order.size()));
  std::partial_sort(order.begin(), end, order.end(), [&](std::size_t i, std::size_t j) {
    return badness(i) != badness(j) ? badness(i) > badness(j) : i < j;
  });
  order.erase(end, order.end());
  return order;
}

}  // namespace facet
