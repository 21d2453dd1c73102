#include "compare/z_test.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "statistics/hypothesis.h"

namespace facet {

namespace {

using Channels = std::array<double, 3>;

/// Sums over a cell of one image.
struct CellSums {
  Channels value{};     ///< of the pixels' means
  Channels variance{};  ///< of those means
  Channels total{};     ///< of all samples
  Channels squares{};   ///< of all samples' squares
  double nonzero = 0;

  /// Kish's effective number of contributions, the least over the channels that are not black.
  [[nodiscard]] double contributions() const {
    double least = nonzero;
    for (std::size_t c = 0; c < 3; ++c) {
      if (squares[c] > 0) least = std::min(least, total[c] * total[c] / squares[c]);
    }
    return least;
  }
};

/// The channels of an image that the test reads.
struct Layers {
  const Image* image;
  std::array<int, 3> value;
  std::array<int, 3> variance;
  int samples;
  int nonzero;

  explicit Layers(const Image& i)
      : image(&i),
        value{i.find_channel("R"), i.find_channel("G"), i.find_channel("B")},
        variance{i.find_channel("variance.R"), i.find_channel("variance.G"),
                 i.find_channel("variance.B")},
        samples(i.find_channel("samples")),
        nonzero(i.find_channel("samples.nonzero")) {
    if (*std::min_element(value.begin(), value.end()) < 0 ||
        *std::min_element(variance.begin(), variance.end()) < 0 || samples < 0 || nonzero < 0) {
      throw InputError("a z-test needs images with variance channels (--aov variance)");
    }
  }

  [[nodiscard]] CellSums sum(int x0, int y0, int size) const {
    CellSums s;
    for (int y = y0; y < std::min(y0 + size, image->height()); ++y) {
      for (int x = x0; x < std::min(x0 + size, image->width()); ++x) add_pixel(s, x, y);
    }
    return s;
  }

 private:
  void add_pixel(CellSums& s, int x, int y) const {
    const double n = image->at(x, y, samples);
    s.nonzero += image->at(x, y, nonzero);
    for (std::size_t c = 0; c < 3; ++c) {
      const double mean = image->at(x, y, value[c]);
      const double var = image->at(x, y, variance[c]);
      s.value[c] += mean;
      s.variance[c] += var;
      s.total[c] += n * mean;
      s.squares[c] += n * (n - 1) * var + n * mean * mean;
    }
  }
};

class ZTest {
 public:
  ZTest(const Image& a, const Image& b, const ZTestCells& cells) : a_(a), b_(b), cells_(cells) {
    if (a.width() != b.width() || a.height() != b.height())
      throw InputError("a z-test needs images of the same size");
  }

  ZTestResult run(double significance) {
    for (int y = 0; y < a_.image->height(); y += largest_cell) {
      for (int x = 0; x < a_.image->width(); x += largest_cell)
        test_cell(x, y, largest_cell, {}, {});
    }
    result_.critical_z = statistics::two_sided_normal_quantile(
        statistics::sidak_significance(significance, result_.cells));
    return result_;
  }

 private:
  /// Pixels of a cell, which may reach over the image's border.
  [[nodiscard]] int area(int x, int y, int size) const {
    return (std::min(x + size, a_.image->width()) - x) *
           (std::min(y + size, a_.image->height()) - y);
  }

  /// Tests a cell in the smallest parts that have enough contributions each. The floors are
  /// variances per pixel.
  void test_cell(int x, int y, int size, const Channels& floor_a, const Channels& floor_b) {
    CellSums a = a_.sum(x, y, size);
    CellSums b = b_.sum(x, y, size);
    const double pixels = area(x, y, size);
    if (size > cells_.least &&
        can_be_divided(x, y, size, std::min(a.contributions(), b.contributions()))) {
      const auto share = [pixels](Channels v) {
        for (double& c : v) c /= pixels;
        return v;
      };
      const Channels next_a = share(a.variance);
      const Channels next_b = share(b.variance);
      for_each_part(x, y, size,
                    [&](int px, int py) { test_cell(px, py, size / 2, next_a, next_b); });
      return;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      // A channel that is black in the cell needs no variance, and gets none from its neighbours.
      if (a.variance[c] > 0) a.variance[c] = std::max(a.variance[c], floor_a[c] * pixels);
      if (b.variance[c] > 0) b.variance[c] = std::max(b.variance[c], floor_b[c] * pixels);
      test_channel(a, b, c, x, y, size);
    }
  }

  template <typename Body>
  void for_each_part(int x, int y, int size, const Body& body) const {
    const int half = size / 2;
    for (const int dy : {0, half}) {
      for (const int dx : {0, half}) {
        if (x + dx < a_.image->width() && y + dy < a_.image->height()) body(x + dx, y + dy);
      }
    }
  }

  /// Whether the cell leaves enough contributions for each part, and each part has them in both
  /// images, or is black in both.
  [[nodiscard]] bool can_be_divided(int x, int y, int size, double contributions) const {
    bool divide = true;
    bool any = contributions >= 4 * cells_.contributions;
    for_each_part(x, y, size, [&](int px, int py) {
      const double a = a_.sum(px, py, size / 2).contributions();
      const double b = b_.sum(px, py, size / 2).contributions();
      divide = divide &&
               ((a >= cells_.contributions && b >= cells_.contributions) || (a == 0 && b == 0));
      any = any || (a == 0 && b == 0);
    });
    return divide && any;
  }

  void test_channel(const CellSums& a, const CellSums& b, std::size_t c, int x, int y, int size) {
    const double variance = a.variance[c] + b.variance[c];
    if (variance == 0) {
      ++result_.cells;
      if (a.value[c] != b.value[c]) ++result_.unequal;
      return;
    }
    if (std::min(a.contributions(), b.contributions()) < cells_.contributions) {
      ++result_.untestable;
      return;
    }
    ++result_.cells;
    const double z = std::abs(a.value[c] - b.value[c]) / std::sqrt(variance);
    // Variances may have overflowed: what cannot be tested so does not hold.
    if (!std::isfinite(z)) ++result_.unequal;
    if (!(z > result_.largest_z)) return;
    result_.largest_z = z;
    result_.worst_x = x;
    result_.worst_y = y;
    result_.worst_size = size;
  }

  Layers a_;
  Layers b_;
  ZTestCells cells_;
  ZTestResult result_;
};

}  // namespace

ZTestResult z_test(const Image& a, const Image& b, double significance, const ZTestCells& cells) {
  return ZTest(a, b, cells).run(significance);
}

std::string ZTestResult::describe() const {
  return fmt::format(
      "largest z {:.2f} of {:.2f} allowed, at pixel ({}, {}), cell {}x{}; {} tests, {} untestable, "
      "{} "
      "unequal",
      largest_z, critical_z, worst_x, worst_y, worst_size, worst_size, cells, untestable, unequal);
}

}  // namespace facet
