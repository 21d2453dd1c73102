#pragma once
// Images, the sums that they are developed from, and the record of how they were made.
#include <facet/request.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace facet {

/// A set of samples: ascending ranges, none of which touch.
class SampleRanges {
 public:
  SampleRanges() = default;
  explicit SampleRanges(const SampleRange& range) { add(range); }

  /// "0:16,32:64"; nothing for any other text.
  [[nodiscard]] static std::optional<SampleRanges> parse(std::string_view text);

  void add(const SampleRange& range);
  void add(const SampleRanges& other);

  [[nodiscard]] bool empty() const { return list_.empty(); }
  [[nodiscard]] const std::vector<SampleRange>& list() const { return list_; }
  /// The smallest range that holds all.
  [[nodiscard]] SampleRange hull() const { return {list_.front().begin, list_.back().end}; }
  /// Number of samples.
  [[nodiscard]] std::uint32_t count() const;
  /// What both hold.
  [[nodiscard]] SampleRanges common(const SampleRanges& other) const;
  /// What of the range is not held.
  [[nodiscard]] SampleRanges missing_in(const SampleRange& range) const;
  /// As parse reads it.
  [[nodiscard]] std::string text() const;

  [[nodiscard]] bool operator==(const SampleRanges&) const = default;

 private:
  std::vector<SampleRange> list_;
};

/// Precision in which the reference computes.
enum class Precision { float_, double_ };

/// Why a render ended: it had its samples, its error was small enough, its time was over, or its
/// caller had enough.
enum class StoppedBy { samples, error, time, interrupt };

/// What a render is a share of: the samples and the pixels of all shares together, and how many
/// shares there are of the samples (parts) and of the rows of pixels (tiles).
struct Division {
  SampleRange samples;
  std::uint32_t parts = 1;
  Crop pixels;
  std::uint32_t tiles = 1;

  [[nodiscard]] bool operator==(const Division&) const = default;
};

/// How an image was made: all that decides its values, and where and when. The EXR header, the JSON
/// report, the command that renders a pixel again, and the checks of merging follow from it
/// (host/image/record.h).
struct RenderRecord {
  std::string version;                   ///< of facet
  std::string scene;                     ///< the scene's file
  std::string integrator;                ///< by its name in the scene language
  std::string sampler;                   ///< likewise
  std::optional<std::uint32_t> planned;  ///< samples of each pixel by which zsobol orders them
  LobeSampling sampling = LobeSampling::visible;
  SampleRanges samples;              ///< of each pixel
  std::optional<Division> division;  ///< where parts or tiles were asked for
  bool adaptive = false;             ///< `samples` says how many there are on average
  std::uint32_t seed = 0;
  int max_depth = -1;  ///< surface interactions of a path, -1: unlimited
  Heuristic heuristic = Heuristic::balance;
  EmitterSelection emitter_selection = EmitterSelection::contribution;
  AreaSampling area_sampling = AreaSampling::area;
  EnvironmentSampling environment_sampling = EnvironmentSampling::compensated;
  int emitter_candidates = 1;      ///< emitter samples of which one is taken
  std::optional<Masking> masking;  ///< where the caller replaced the scene's
  std::string filter;              ///< reconstruction filter and its parameters
  std::uint64_t fingerprint =
      0;                ///< of all that the scene's files say and that no field above tells
  std::string backend;  ///< "vulkan" or "reference"
  Precision precision = Precision::float_;
  std::string device;
  std::string driver;
  double seconds = 0;  ///< of rendering
  StoppedBy stopped_by = StoppedBy::samples;
};

/// Where an image lies in a larger one, and that one's size.
struct ImageWindow {
  int x = 0;
  int y = 0;
  int full_width = 0;
  int full_height = 0;
};

/// Planes of floats, rows from the top. Channels have EXR names: "R", "G", "B", "variance.R", ...
class Image {
 public:
  Image() = default;
  /// All zero.
  Image(int width, int height, std::vector<std::string> channels);

  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  [[nodiscard]] const std::vector<std::string>& channels() const noexcept { return channels_; }
  /// Index of a channel, -1 if there is none of that name.
  [[nodiscard]] int find_channel(const std::string& name) const;

  [[nodiscard]] float& at(int x, int y, int channel) { return data_[index(x, y, channel)]; }
  [[nodiscard]] float at(int x, int y, int channel) const { return data_[index(x, y, channel)]; }
  /// First value of a channel's plane.
  [[nodiscard]] float* plane(int channel) { return data_.data() + index(0, 0, channel); }
  [[nodiscard]] const float* plane(int channel) const {
    return data_.data() + index(0, 0, channel);
  }

  /// A crop's place; by default the image's own size.
  ImageWindow window;

  /// Text that a file's header carries, in order.
  std::vector<std::pair<std::string, std::string>> metadata;

 private:
  [[nodiscard]] std::size_t index(int x, int y, int channel) const {
    const auto w = static_cast<std::size_t>(width_);
    const auto plane = static_cast<std::size_t>(channel) * static_cast<std::size_t>(height_);
    return (plane + static_cast<std::size_t>(y)) * w + static_cast<std::size_t>(x);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<std::string> channels_;
  std::vector<float> data_;
};

/// Sums over the samples of one pixel, for the channels R, G and B; radiances in W sr^-1 m^-2.
struct PixelSums {
  std::array<double, 3> values{};
  std::array<double, 3> squares{};  ///< 0 where the film keeps none
  std::uint32_t samples = 0;
  std::uint32_t nonzero = 0;  ///< samples whose value is not zero

  void add(const std::array<double, 3>& value);
  /// The pixel's estimate; 0 without samples.
  [[nodiscard]] std::array<double, 3> mean() const;
  [[nodiscard]] bool operator==(const PixelSums&) const = default;
};

/// A second estimate of a pixel, of as many samples as the first, which is no part of the image:
/// what the two differ by tells of their error.
struct Probe {
  std::size_t pixel = 0;  ///< of the film
  PixelSums sums;
};

/// Pixels of an image or of a crop of it, row by row from the top.
struct Film {
  int width = 0;
  int height = 0;
  ImageWindow window;
  bool has_squares = false;
  std::vector<PixelSums> pixels;
  std::vector<Probe> probes;  ///< of some pixels, or none
  RenderRecord record;

  // x and y count from the film's own corner.
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] bool holds(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height;
  }
  [[nodiscard]] const PixelSums& at(int x, int y) const { return pixels[index(x, y)]; }
};

/// What a film says about the error of its image: the relative mean square error, relMSE.
struct ErrorEstimate {
  double relmse = 0;             ///< 0 where nothing is known
  double standard_error = 0;     ///< between the estimate and the error itself
  double degrees = 0;            ///< of freedom of Student's t, which the two differ by
  std::uint32_t replicates = 0;  ///< independent estimates of a pixel that are compared
  std::size_t probes = 0;  ///< pixels with a second estimate; without any, samples are compared

  /// The root.
  [[nodiscard]] double relative() const { return std::sqrt(relmse); }
  /// What the root is at most, with a confidence from 0 to 1.
  [[nodiscard]] double relative_upper(double confidence) const;
};

/// Estimated by the samples' variances and the probes; 0 for a film without squares. What no sample
/// has seen, no estimate knows of.
[[nodiscard]] ErrorEstimate estimate_error(const Film& film);

/// Channels R, G, B: the mean over samples; the record as metadata. With variance also variance.R,
/// variance.G, variance.B (of the mean), samples and samples.nonzero; the film must have squares
/// for it. An adaptive render's has samples in any case.
[[nodiscard]] Image develop(const Film& film, bool with_variance);

}  // namespace facet
