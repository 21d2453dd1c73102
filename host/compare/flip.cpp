#include "compare/flip.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/flip_map.h"
#include "compare/metrics.h"
#include "core/error.h"
#include "core/maths.h"

namespace facet {

namespace {

using Planes = std::array<const float*, 3>;

/// The two images, and which pixels count.
class Pair {
 public:
  Pair(const Image& image, const Image& reference, double pixels_per_degree)
      : planes_{checked(image, reference, pixels_per_degree), rgb_planes(reference)},
        map_(image.width(), image.height(), pixels_per_degree),
        finite_(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()),
                true) {
    for (const Planes& planes : planes_) {
      for (const float* plane : planes) {
        for (std::size_t i = 0; i < finite_.size(); ++i)
          finite_[i] = finite_[i] && std::isfinite(plane[i]);
      }
    }
  }

  [[nodiscard]] const std::vector<bool>& finite() const { return finite_; }

  /// The map after a tone curve from linear values of at least 0 to [0, 1].
  template <typename Curve>
  [[nodiscard]] Plane compare(const Curve& curve) const {
    return map_.compare(displayed(planes_[0], curve), displayed(planes_[1], curve));
  }

  /// Luminances of the reference, sorted; negative channels and pixels that do not count as 0.
  [[nodiscard]] std::vector<double> sorted_luminances() const {
    std::vector<double> luminances;
    const auto at = [&](std::size_t c, std::size_t i) {
      return std::max(0.0, double{planes_[1][c][i]});
    };
    for (std::size_t i = 0; i < finite_.size(); ++i) {
      if (finite_[i]) luminances.push_back(luminance(dvec3(at(0, i), at(1, i), at(2, i))));
    }
    std::sort(luminances.begin(), luminances.end());
    return luminances;
  }

 private:
  static Planes checked(const Image& image, const Image& reference, double pixels_per_degree) {
    if (!(pixels_per_degree >= 1 && pixels_per_degree <= 1000))
      throw InputError(
          fmt::format("FLIP needs 1 to 1000 pixels a degree, not {:g}", pixels_per_degree));
    check_comparable(image, "the image", reference, "the reference");
    return rgb_planes(image);
  }

  template <typename Curve>
  [[nodiscard]] RgbPlanes displayed(const Planes& planes, const Curve& curve) const {
    RgbPlanes result;
    for (std::size_t c = 0; c < 3; ++c) {
      result[c].resize(finite_.size());
      for (std::size_t i = 0; i < finite_.size(); ++i) {
        const double value = finite_[i] ? std::max(0.0, double{planes[c][i]}) : 0.0;
        result[c][i] = static_cast<float>(std::min(1.0, static_cast<double>(curve(value))));
      }
    }
    return result;
  }

  std::array<Planes, 2> planes_;
  FlipMap map_;
  std::vector<bool> finite_;
};

/// K. Narkowicz's rational fit of the ACES tone curve, with the scale of 0.6 that undoes its
/// exposure: (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5).
struct ToneCurve {
  static constexpr double k0 = 0.36 * 2.51;
  static constexpr double k1 = 0.6 * 0.03;
  static constexpr double k3 = 0.36 * 2.43;
  static constexpr double k4 = 0.6 * 0.59;
  static constexpr double k5 = 0.14;

  static double map(double x) { return x * (k0 * x + k1) / (x * (k3 * x + k4) + k5); }

  /// The x > 0 with map(x) = y, y in (0, 1).
  static double inverse(double y) {
    const double a = k0 - y * k3;
    const double b = k1 - y * k4;
    return (-b + std::sqrt(b * b + 4 * a * y * k5)) / (2 * a);
  }
};

/// Mean and largest of the pixels that count; the others become NaN.
void pool(FlipResult& result, const std::vector<bool>& finite) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < finite.size(); ++i) {
    if (!finite[i]) {
      result.map[i] = std::numeric_limits<float>::quiet_NaN();
      continue;
    }
    sum += result.map[i];
    result.largest = std::max(result.largest, double{result.map[i]});
    ++count;
  }
  if (count == 0) result.largest = std::numeric_limits<double>::quiet_NaN();
  result.mean = count > 0 ? sum / static_cast<double>(count) : result.largest;
}

void choose_exposures(HdrFlipResult& result, const std::vector<double>& luminances) {
  result.exposures = 2;
  if (luminances.empty() || luminances.back() == 0) return;
  const auto median_from = [&](std::vector<double>::const_iterator first) {
    const auto n = luminances.end() - first;
    return 0.5 * (first[(n - 1) / 2] + first[n / 2]);
  };
  double median = median_from(luminances.begin());
  if (median == 0)
    median = median_from(std::upper_bound(luminances.begin(), luminances.end(), 0.0));
  const double bright = ToneCurve::inverse(0.85);
  result.start_exposure = std::log2(bright / luminances.back());
  result.stop_exposure = std::log2(bright / median);
  result.exposures =
      std::max(2, static_cast<int>(std::ceil(result.stop_exposure - result.start_exposure)));
}

}  // namespace

FlipResult flip(const Image& image, const Image& reference, double pixels_per_degree) {
  const Pair pair(image, reference, pixels_per_degree);
  FlipResult result;
  result.map = pair.compare([](double x) { return x; });
  pool(result, pair.finite());
  return result;
}

HdrFlipResult hdr_flip(const Image& image, const Image& reference, double pixels_per_degree) {
  const Pair pair(image, reference, pixels_per_degree);
  HdrFlipResult result;
  choose_exposures(result, pair.sorted_luminances());
  result.map.assign(pair.finite().size(), 0);
  for (int i = 0; i < result.exposures; ++i) {
    const double exposure =
        result.start_exposure +
        i * (result.stop_exposure - result.start_exposure) / (result.exposures - 1);
    const double factor = std::exp2(exposure);
    const Plane map = pair.compare([factor](double x) { return ToneCurve::map(factor * x); });
    std::transform(map.begin(), map.end(), result.map.begin(), result.map.begin(),
                   [](float a, float b) { return std::max(a, b); });
  }
  pool(result, pair.finite());
  return result;
}

}  // namespace facet
