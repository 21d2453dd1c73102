#include "render/film.h"

#include <array>
#include <cmath>

#include "core/maths.h"

namespace facet {

namespace {

std::array<double, 3> values_of(const shared::FilmRecord& r) {
  return {static_cast<double>(r.hi_r) + r.lo_r, static_cast<double>(r.hi_g) + r.lo_g,
          static_cast<double>(r.hi_b) + r.lo_b};
}

/// Sums of squares of the values themselves.
std::array<double, 3> squares_of(const FilmData& film, std::size_t i) {
  std::array<double, 3> squares = values_of(film.squares[i]);
  for (double& s : squares) s /= static_cast<double>(film.square_scale) * film.square_scale;
  return squares;
}

/// Variance of a mean of n samples from the sums of values and of squares.
double variance_of_mean(double sum, double squares, double n) {
  if (n < 2) return 0;
  const double mean = sum / n;
  return std::max(0.0, squares / n - mean * mean) / (n - 1);
}

}  // namespace

Image develop(const FilmData& film, const Crop& crop, int full_width, int full_height, bool with_variance) {
  std::vector<std::string> channels{"R", "G", "B"};
  if (with_variance) {
    for (const char* name : {"variance.R", "variance.G", "variance.B", "samples", "samples.nonzero"})
      channels.emplace_back(name);
  }
  Image image(crop.x1 - crop.x0, crop.y1 - crop.y0, channels);
  image.window = {crop.x0, crop.y0, full_width, full_height};
  std::size_t i = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x, ++i) {
      const double n = film.sums[i].samples;
      const std::array<double, 3> sum = values_of(film.sums[i]);
      for (int c = 0; c < 3; ++c)
        image.at(x, y, c) = static_cast<float>(n > 0 ? sum[static_cast<std::size_t>(c)] / n : 0.0);
      if (!with_variance) continue;
      const std::array<double, 3> squares = squares_of(film, i);
      for (int c = 0; c < 3; ++c) {
        const auto k = static_cast<std::size_t>(c);
        image.at(x, y, 3 + c) = static_cast<float>(variance_of_mean(sum[k], squares[k], n));
      }
      image.at(x, y, 6) = static_cast<float>(n);
      image.at(x, y, 7) = static_cast<float>(film.sums[i].nonzero);
    }
  }
  return image;
}

double estimate_relmse(const FilmData& film) {
  if (film.squares.empty()) return 0;
  double luminance_sum = 0;
  for (const shared::FilmRecord& r : film.sums) {
    const auto v = values_of(r);
    if (r.samples > 0) luminance_sum += (0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2]) / r.samples;
  }
  const double mean_luminance = 0.01 * luminance_sum / static_cast<double>(film.sums.size());
  const double epsilon = mean_luminance * mean_luminance;
  double total = 0;
  for (std::size_t i = 0; i < film.sums.size(); ++i) {
    const auto sum = values_of(film.sums[i]);
    const auto squares = squares_of(film, i);
    const double n = film.sums[i].samples;
    for (std::size_t c = 0; c < 3; ++c) {
      const double variance = variance_of_mean(sum[c], squares[c], n);
      const double mean = n > 0 ? sum[c] / n : 0;
      if (variance > 0) total += variance / (mean * mean + epsilon);
    }
  }
  return total / (3.0 * static_cast<double>(film.sums.size()));
}

}  // namespace facet
