#include "report/test_picture.h"

#include <algorithm>
#include <cmath>

#include "image/files.h"

namespace facet::report {

namespace {

/// Of a panel and of the gap between two, pixels.
constexpr int least_panel_width = 320;
constexpr int gap = 8;
constexpr double full_colour = 5;

Color brightness(double count, double most) {
  return Color(static_cast<float>(most > 0 ? std::sqrt(count / most) : 0.0));
}

/// White where equal.
Color deviation(double observed, double expected) {
  const double deviations = (observed - expected) / std::sqrt(std::max(expected, 1.0));
  const auto t = static_cast<float>(std::clamp(std::abs(deviations) / full_colour, 0.0, 1.0));
  return deviations > 0 ? Color(1, 1 - t, 1 - t) : Color(1 - t, 1 - t, 1);
}

}  // namespace

void write_histogram_picture(const std::filesystem::path& path,
                             const statistics::SphereHistogram& h) {
  const int side = std::max(1, least_panel_width / h.columns);
  const int width = side * h.columns;
  const int panel = side * h.rows;
  Image image(width, 3 * panel + 2 * gap, {"R", "G", "B"});
  // Gaps of a colour that no panel has.
  std::fill_n(image.plane(1), width * image.height(), 0.5F);
  double most = 0;
  for (std::size_t i = 0; i < h.observed.size(); ++i)
    most = std::max({most, h.observed[i], h.expected[i]});
  for (int y = 0; y < panel; ++y) {
    for (int x = 0; x < width; ++x) {
      const int row = h.rows - 1 - y / side;
      const int place = row * h.columns + x / side;
      const auto bin = static_cast<std::size_t>(place);
      const Color colours[3] = {brightness(h.observed[bin], most),
                                brightness(h.expected[bin], most),
                                deviation(h.observed[bin], h.expected[bin])};
      for (int p = 0; p < 3; ++p) {
        for (int c = 0; c < 3; ++c) image.at(x, y + p * (panel + gap), c) = colours[p][c];
      }
    }
  }
  write_png(path, image, 0);
}

}  // namespace facet::report
