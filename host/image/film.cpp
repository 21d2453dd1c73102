#include "image/film.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/memory.h"
#include "image/record.h"

namespace facet {

void PixelSums::add(const std::array<double, 3>& value) {
  bool any = false;
  for (std::size_t c = 0; c < 3; ++c) {
    values[c] += value[c];
    squares[c] += value[c] * value[c];
    any = any || value[c] != 0;
  }
  ++samples;
  if (any) ++nonzero;
}

std::array<double, 3> PixelSums::mean() const {
  std::array<double, 3> result{};
  for (std::size_t c = 0; c < 3; ++c) result[c] = samples > 0 ? values[c] / samples : 0;
  return result;
}

Film make_film(int width, int height, const ImageWindow& window, bool with_squares) {
  const Activity activity(fmt::format("making the film of {}x{} pixels", width, height),
                          sizeof(PixelSums), "pixels");
  Film film{width, height, window, with_squares, {}, {}, {}};
  film.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return film;
}

void add_sums(PixelSums& sums, const PixelSums& more) {
  for (std::size_t c = 0; c < 3; ++c) {
    sums.values[c] += more.values[c];
    sums.squares[c] += more.squares[c];
  }
  sums.samples += more.samples;
  sums.nonzero += more.nonzero;
}

double variance_of_mean(double sum, double squares, double n) {
  if (n < 2) return 0;
  const double mean = sum / n;
  return std::max(0.0, squares / n - mean * mean) / (n - 1);
}

Image with_channels(const Image& image, const std::vector<std::string>& more) {
  std::vector<std::string> channels = image.channels();
  channels.insert(channels.end(), more.begin(), more.end());
  Image wider(image.width(), image.height(), channels);
  wider.window = image.window;
  wider.metadata = image.metadata;
  const std::size_t pixels =
      static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  std::copy_n(image.plane(0), pixels * image.channels().size(), wider.plane(0));
  return wider;
}

void add_samples(Film& film, const Film& more) {
  const int x = more.window.x - film.window.x;
  const int y = more.window.y - film.window.y;
  if (!film.holds(x, y) || !film.holds(x + more.width - 1, y + more.height - 1))
    throw std::logic_error("samples for pixels that the film does not have");
  if (film.has_squares && !more.has_squares) {
    film.has_squares = false;
    for (PixelSums& sums : film.pixels) sums.squares = {};
  }
  for (int row = 0; row < more.height; ++row) {
    PixelSums* sums = &film.pixels[film.index(x, y + row)];
    const PixelSums* added = &more.pixels[more.index(0, row)];
    for (int i = 0; i < more.width; ++i, ++sums, ++added) {
      add_sums(*sums, *added);
      if (!film.has_squares) sums->squares = {};
    }
  }
}

Image develop(const Film& film, bool with_variance) {
  const Activity activity(
      fmt::format("developing the image of {}x{} pixels", film.width, film.height));
  std::vector<std::string> channels{"R", "G", "B"};
  if (with_variance) {
    for (const char* name :
         {"variance.R", "variance.G", "variance.B", "samples", "samples.nonzero"})
      channels.emplace_back(name);
  }
  if (film.record.adaptive && !with_variance) channels.emplace_back("samples");
  Image image(film.width, film.height, channels);
  const int samples = image.find_channel("samples");
  image.window = film.window;
  // A film that no renderer has made has nothing to tell.
  if (!film.record.version.empty()) image.metadata = header_of(film.record);
  auto pixel = film.pixels.begin();
  for (int y = 0; y < film.height; ++y) {
    for (int x = 0; x < film.width; ++x, ++pixel) {
      const double n = pixel->samples;
      const std::array<double, 3> mean = pixel->mean();
      for (int c = 0; c < 3; ++c) {
        const auto k = static_cast<std::size_t>(c);
        image.at(x, y, c) = static_cast<float>(mean[k]);
        if (with_variance)
          image.at(x, y, 3 + c) =
              static_cast<float>(variance_of_mean(pixel->values[k], pixel->squares[k], n));
      }
      if (samples >= 0) image.at(x, y, samples) = static_cast<float>(n);
      if (with_variance) image.at(x, y, samples + 1) = static_cast<float>(pixel->nonzero);
    }
  }
  return image;
}

}  // namespace facet
