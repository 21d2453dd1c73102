#include "image/z_test.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"

namespace facet {

namespace {

constexpr int largest_cell = 16;
constexpr double least_contributions = 30;

/// Sums over a cell of one image.
struct CellSums {
  std::array<double, 3> value{};
  std::array<double, 3> variance{};
  double nonzero = 0;
};

/// The channels of an image that the test reads.
struct Layers {
  const Image* image;
  std::array<int, 3> value;
  std::array<int, 3> variance;
  int nonzero;

  explicit Layers(const Image& i)
      : image(&i),
        value{i.find_channel("R"), i.find_channel("G"), i.find_channel("B")},
        variance{i.find_channel("variance.R"), i.find_channel("variance.G"), i.find_channel("variance.B")},
        nonzero(i.find_channel("samples.nonzero")) {
    if (value[0] < 0 || value[1] < 0 || value[2] < 0 || variance[0] < 0 || variance[1] < 0 ||
        variance[2] < 0 || nonzero < 0) {
      throw InputError("a z-test needs images with variance channels (--aov variance)");
    }
  }

  [[nodiscard]] CellSums sum(int x0, int y0, int size) const {
    CellSums s;
    for (int y = y0; y < std::min(y0 + size, image->height()); ++y) {
      for (int x = x0; x < std::min(x0 + size, image->width()); ++x) {
        s.nonzero += image->at(x, y, nonzero);
        for (std::size_t c = 0; c < 3; ++c) {
          s.value[c] += image->at(x, y, value[c]);
          s.variance[c] += image->at(x, y, variance[c]);
        }
      }
    }
    return s;
  }
};

class ZTest {
 public:
  ZTest(const Image& a, const Image& b) : a_(a), b_(b) {
    if (a.width() != b.width() || a.height() != b.height())
      throw InputError("a z-test needs images of the same size");
  }

  ZTestResult run(double significance) {
    for (int y = 0; y < a_.image->height(); y += largest_cell) {
      for (int x = 0; x < a_.image->width(); x += largest_cell) test_cell(x, y, largest_cell);
    }
    const auto tests = static_cast<double>(std::max<std::size_t>(result_.cells, 1));
    result_.critical_z = two_sided_normal_quantile(-std::expm1(std::log1p(-significance) / tests));
    return result_;
  }

 private:
  /// Tests a cell in the smallest parts that have enough contributions each.
  void test_cell(int x, int y, int size) {
    if (size > 1 && can_be_divided(x, y, size)) {
      const int half = size / 2;
      for (const int dy : {0, half}) {
        for (const int dx : {0, half}) {
          if (x + dx < a_.image->width() && y + dy < a_.image->height()) test_cell(x + dx, y + dy, half);
        }
      }
      return;
    }
    const CellSums a = a_.sum(x, y, size);
    const CellSums b = b_.sum(x, y, size);
    for (std::size_t c = 0; c < 3; ++c) test_channel(a, b, c, x, y, size);
  }

  /// Whether each quarter has enough contributions in both images, or is black in both.
  [[nodiscard]] bool can_be_divided(int x, int y, int size) const {
    const int half = size / 2;
    for (const int dy : {0, half}) {
      for (const int dx : {0, half}) {
        const double a = a_.sum(x + dx, y + dy, half).nonzero;
        const double b = b_.sum(x + dx, y + dy, half).nonzero;
        if ((a < least_contributions || b < least_contributions) && (a > 0 || b > 0)) return false;
      }
    }
    return true;
  }

  void test_channel(const CellSums& a, const CellSums& b, std::size_t c, int x, int y, int size) {
    const double variance = a.variance[c] + b.variance[c];
    if (variance == 0) {
      ++result_.cells;
      if (a.value[c] != b.value[c]) ++result_.unequal;
      return;
    }
    if (a.nonzero < least_contributions || b.nonzero < least_contributions) {
      ++result_.untestable;
      return;
    }
    ++result_.cells;
    const double z = std::abs(a.value[c] - b.value[c]) / std::sqrt(variance);
    if (z <= result_.largest_z) return;
    result_.largest_z = z;
    result_.worst_x = x;
    result_.worst_y = y;
    result_.worst_size = size;
  }

  Layers a_;
  Layers b_;
  ZTestResult result_;
};

}  // namespace

double two_sided_normal_quantile(double p) {
  double low = 0;
  double high = 40;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (std::erfc(middle / std::sqrt(2.0)) > p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

ZTestResult z_test(const Image& a, const Image& b, double significance) {
  return ZTest(a, b).run(significance);
}

std::string ZTestResult::describe() const {
  return fmt::format(
      "largest z {:.2f} of {:.2f} allowed, at pixel ({}, {}), cell {}x{}; {} tests, {} untestable, {} "
      "unequal",
      largest_z, critical_z, worst_x, worst_y, worst_size, worst_size, cells, untestable, unequal);
}

}  // namespace facet
