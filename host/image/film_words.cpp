#include "image/film_words.h"

#include <bit>
#include <stdexcept>

namespace facet {

namespace {

void put_double(std::vector<WordPlane>& planes, std::size_t plane, std::size_t i, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  planes[plane][i] = static_cast<std::uint32_t>(bits >> 32U);
  planes[plane + 1][i] = static_cast<std::uint32_t>(bits);
}

double get_double(const std::vector<WordPlane>& planes, std::size_t plane, std::size_t i) {
  const std::uint64_t high = planes[plane][i];
  return std::bit_cast<double>(high << 32U | planes[plane + 1][i]);
}

void check_planes(const std::vector<WordPlane>& planes, std::size_t count) {
  bool fits = planes.size() == count;
  for (const WordPlane& plane : planes) fits = fits && plane.size() == planes.front().size();
  if (!fits) throw std::invalid_argument("words of something else");
}

}  // namespace

std::vector<WordPlane> words_of(const std::vector<PixelSums>& pixels) {
  std::vector<WordPlane> planes(planes_of_sums, WordPlane(pixels.size()));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      put_double(planes, 2 * c, i, pixels[i].values[c]);
      put_double(planes, 6 + 2 * c, i, pixels[i].squares[c]);
    }
    planes[12][i] = pixels[i].samples;
    planes[13][i] = pixels[i].nonzero;
  }
  return planes;
}

std::vector<PixelSums> sums_of(const std::vector<WordPlane>& planes) {
  check_planes(planes, planes_of_sums);
  std::vector<PixelSums> pixels(planes.front().size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      pixels[i].values[c] = get_double(planes, 2 * c, i);
      pixels[i].squares[c] = get_double(planes, 6 + 2 * c, i);
    }
    pixels[i].samples = planes[12][i];
    pixels[i].nonzero = planes[13][i];
  }
  return pixels;
}

std::vector<WordPlane> words_of(const std::vector<double>& values) {
  std::vector<WordPlane> planes(2, WordPlane(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) put_double(planes, 0, i, values[i]);
  return planes;
}

std::vector<double> doubles_of(const std::vector<WordPlane>& planes) {
  check_planes(planes, 2);
  std::vector<double> values(planes.front().size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = get_double(planes, 0, i);
  return values;
}

}  // namespace facet
