#include "parts/part.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "core/text.h"
#include "image/film.h"
#include "image/record.h"
#include "parts/checksum.h"

namespace facet {

namespace {

constexpr const char* sum_exponent_key = "facet.sumExponent";
constexpr const char* square_exponent_key = "facet.squareExponent";
constexpr std::array<const char*, 3> colors{"R", "G", "B"};

using Sums = std::array<double, 3> PixelSums::*;

/// A number as the unevaluated sum of two floats.
struct Pair {
  float high = 0;
  float low = 0;

  explicit Pair(double value) : high(static_cast<float>(value)) {
    if (std::isfinite(high)) low = static_cast<float>(value - high);
  }
  Pair(float h, float l) : high(h), low(l) {}
  [[nodiscard]] double value() const { return static_cast<double>(high) + low; }
};

/// The power of two by which the sums are divided so that pairs of floats hold them.
int choose_exponent(const Film& film, Sums sums) {
  double largest = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (const PixelSums& pixel : film.pixels) {
    for (const double sum : pixel.*sums) {
      if (!std::isfinite(sum) || sum == 0) continue;
      largest = std::max(largest, std::abs(sum));
      smallest = std::min(smallest, std::abs(sum));
    }
  }
  if (largest <= 0x1p126 && smallest >= 0x1p-100) return 0;
  return std::ilogb(largest) + 1 - 127;
}

/// value * 2^exponent; fast for the usual exponent.
double scaled(double value, int exponent) {
  return exponent == 0 ? value : std::ldexp(value, exponent);
}

/// Index of a channel of a part's image. Throws InputError where it has none.
int find_plane(const Image& image, const std::string& channel, const std::string& file) {
  const int index = image.find_channel(channel);
  if (index < 0) throw InputError(fmt::format("{}: lacks the channel {} of a part", file, channel));
  return index;
}

/// The planes of a pair's channels within an image: Plane is float* or const float*.
template <typename Plane>
class PairPlanes {
 public:
  template <typename AnyImage>
  PairPlanes(AnyImage& image, const std::string& channel, const std::string& file)
      : high_(image.plane(find_plane(image, channel, file))),
        low_(image.plane(find_plane(image, channel + ".low", file))) {}

  void set(std::size_t i, const Pair& pair) const {
    high_[i] = pair.high;
    low_[i] = pair.low;
  }
  [[nodiscard]] double get(std::size_t i) const { return Pair(high_[i], low_[i]).value(); }

 private:
  Plane high_;
  Plane low_;
};

template <typename AnyImage>
PairPlanes(AnyImage& image, const std::string& channel, const std::string& file)
    -> PairPlanes<decltype(image.plane(0))>;

/// Adds the names of a pair's channels to the list.
void name_pair(std::vector<std::string>& channels, const std::string& channel, bool high_is_there) {
  if (!high_is_there) channels.push_back(channel);
  channels.push_back(channel + ".low");
}

void round_to_pairs(Film& film, Sums sums, int exponent) {
  for (PixelSums& pixel : film.pixels) {
    for (double& sum : pixel.*sums) sum = scaled(Pair(scaled(sum, -exponent)).value(), exponent);
  }
}

void write_sums(Image& image, const Film& film, Sums sums, const std::string& prefix,
                int exponent) {
  const std::array planes{PairPlanes(image, prefix + colors[0], ""),
                          PairPlanes(image, prefix + colors[1], ""),
                          PairPlanes(image, prefix + colors[2], "")};
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      planes[c].set(i, Pair(scaled((film.pixels[i].*sums)[c], -exponent)));
  }
}

void write_counts(Image& image, const Film& film, std::uint32_t PixelSums::*count,
                  const std::string& channel) {
  const PairPlanes planes(image, channel, "");
  for (std::size_t i = 0; i < film.pixels.size(); ++i) planes.set(i, Pair(film.pixels[i].*count));
}

int read_exponent(const Image& image, const std::string& key, const std::string& file) {
  const std::string* text = find_metadata(image.metadata, key);
  const auto exponent = text == nullptr ? std::nullopt : parse_integer(*text);
  if (!exponent || *exponent < -2000 || *exponent > 2000)
    throw InputError(fmt::format("{}: lacks the metadata {} of a part", file, key));
  return static_cast<int>(*exponent);
}

/// Reads the pixels of a part one by one, and checks each.
class PartReader {
 public:
  PartReader(const Image& image, std::uint32_t most_samples, const std::string& file)
      : width_(static_cast<std::size_t>(image.width())),
        most_samples_(most_samples),
        file_(file),
        samples_(image, "samples", file),
        nonzero_(image, "samples.nonzero", file),
        sums_(planes_of(image, "sum.")),
        sum_scale_(read_exponent(image, sum_exponent_key, file)) {
    for (std::size_t c = 0; c < 3; ++c) means_[c] = image.plane(find_plane(image, colors[c], file));
    if (image.find_channel("square.R") < 0) return;
    squares_ = planes_of(image, "square.");
    square_scale_ = read_exponent(image, square_exponent_key, file);
  }

  void read(std::size_t i, PixelSums& pixel) const {
    pixel.samples = count(samples_, "samples", i);
    pixel.nonzero = count(nonzero_, "samples.nonzero", i);
    if (pixel.nonzero > pixel.samples)
      fail_at(i, fmt::format("has {} samples, but {} of them are not zero", pixel.samples,
                             pixel.nonzero));
    for (std::size_t c = 0; c < 3; ++c) {
      pixel.values[c] = scaled(sums_[c].get(i), sum_scale_);
      if (!squares_.empty()) pixel.squares[c] = scaled(squares_[c].get(i), square_scale_);
    }
    check_means(i, pixel);
  }

 private:
  using Planes = PairPlanes<const float*>;

  [[nodiscard]] std::vector<Planes> planes_of(const Image& image, const std::string& prefix) const {
    std::vector<Planes> planes;
    planes.reserve(colors.size());
    for (const char* color : colors) planes.emplace_back(image, prefix + color, file_);
    return planes;
  }

  [[nodiscard]] std::uint32_t count(const Planes& planes, const char* channel,
                                    std::size_t i) const {
    const double count = planes.get(i);
    if (!(count >= 0 && count <= most_samples_ && count == std::floor(count)))
      fail_at(i,
              fmt::format("has {} in {}, but there are {} samples", count, channel, most_samples_));
    return static_cast<std::uint32_t>(count);
  }

  /// Means follow from sums: a file that another program has changed or stored with less precision
  /// is found.
  void check_means(std::size_t i, const PixelSums& pixel) const {
    const std::array<double, 3> means = pixel.mean();
    for (std::size_t c = 0; c < 3; ++c) {
      const float told = means_[c][i];
      const auto mean = static_cast<float>(means[c]);
      if (told == mean || (std::isnan(told) && std::isnan(mean))) continue;
      fail_at(i, fmt::format("has {} = {}, but its sum makes {}", colors[c], told, mean));
    }
  }

  /// Throws InputError about a pixel of a file that was changed after the render, or never was one.
  [[noreturn]] void fail_at(std::size_t i, const std::string& what) const {
    throw InputError(fmt::format("{}: damaged, or changed after it was rendered: pixel ({}, {}) {}",
                                 file_, i % width_, i / width_, what));
  }

  std::size_t width_;
  std::uint32_t most_samples_;
  const std::string& file_;
  Planes samples_;
  Planes nonzero_;
  std::vector<Planes> sums_;
  std::vector<Planes> squares_;
  int sum_scale_;
  int square_scale_ = 0;
  std::array<const float*, 3> means_{};
};

}  // namespace

Image make_part(const Film& film, bool with_variance, const std::vector<WordChannel>& words,
                const Metadata& metadata) {
  Film kept = film;
  const int sum_exponent = choose_exponent(film, &PixelSums::values);
  const int square_exponent = choose_exponent(film, &PixelSums::squares);
  round_to_pairs(kept, &PixelSums::values, sum_exponent);
  round_to_pairs(kept, &PixelSums::squares, square_exponent);
  Image image = develop(kept, with_variance);
  std::vector<std::string> channels;
  for (const std::string color : colors) name_pair(channels, "sum." + color, false);
  if (film.has_squares) {
    for (const std::string color : colors) name_pair(channels, "square." + color, false);
  }
  name_pair(channels, "samples", image.find_channel("samples") >= 0);
  name_pair(channels, "samples.nonzero", with_variance);
  for (const WordChannel& channel : words) channels.push_back(channel.name);
  image = with_channels(image, channels);
  write_sums(image, kept, &PixelSums::values, "sum.", sum_exponent);
  image.metadata.emplace_back(sum_exponent_key, fmt::format("{}", sum_exponent));
  if (film.has_squares) {
    write_sums(image, kept, &PixelSums::squares, "square.", square_exponent);
    image.metadata.emplace_back(square_exponent_key, fmt::format("{}", square_exponent));
  }
  write_counts(image, kept, &PixelSums::samples, "samples");
  write_counts(image, kept, &PixelSums::nonzero, "samples.nonzero");
  for (const auto& [name, plane] : words) {
    std::memcpy(image.plane(image.find_channel(name)), plane->data(),
                plane->size() * sizeof(std::uint32_t));
  }
  image.metadata.insert(image.metadata.end(), metadata.begin(), metadata.end());
  add_checksum(image);
  return image;
}

Film film_of_part(const Image& image, std::uint32_t most_samples, const std::string& name) {
  Film film =
      make_film(image.width(), image.height(), image.window, image.find_channel("square.R") >= 0);
  const PartReader reader(image, most_samples, name);
  for (std::size_t i = 0; i < film.pixels.size(); ++i) reader.read(i, film.pixels[i]);
  return film;
}

}  // namespace facet
