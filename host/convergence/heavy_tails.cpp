#include "convergence/heavy_tails.h"

#include <algorithm>

#include "convergence/relative_variance.h"

namespace facet {

namespace {

/// Of one pixel, summed over its channels.
struct PixelError {
  double variance = 0;  ///< of the mean
  double squared_mean = 0;

  explicit PixelError(const PixelSums& pixel) {
    for (const double v : variance_by_samples(pixel)) variance += v;
    for (const double m : pixel.mean()) squared_mean += m * m;
  }
};

}  // namespace

HeavyTails find_heavy_tails(const Film& film) {
  HeavyTails tails;
  if (!film.has_squares) return tails;
  double all = 0;
  double theirs = 0;
  std::vector<std::pair<double, std::size_t>> found;
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    const PixelError error(film.pixels[i]);
    all += error.variance;
    const bool tells = film.pixels[i].samples >= HeavyTails::least_samples;
    if (!tells || !(error.squared_mean < HeavyTails::few * error.variance)) continue;
    theirs += error.variance;
    tails.samples = std::max(tails.samples, film.pixels[i].samples);
    found.emplace_back(error.variance, i);
  }
  if (found.empty()) return tails;
  tails.pixels = found.size();
  tails.variance_share = theirs / all;
  const std::size_t count = std::min<std::size_t>(found.size(), 10);
  std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count), found.end(),
                    [](const auto& a, const auto& b) {
                      return a.first != b.first ? a.first > b.first : a.second < b.second;
                    });
  const auto width = static_cast<std::size_t>(film.width);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = found[k].second;
    tails.worst.push_back(
        {film.window.x + static_cast<int>(i % width), film.window.y + static_cast<int>(i / width)});
  }
  return tails;
}

}  // namespace facet
