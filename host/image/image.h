#pragma once
// Images of named float channels.
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace facet {

/// Planes of floats, rows from the top. `channels` are EXR channel names: "R", "G", "B", "variance.R", ...
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
  [[nodiscard]] const float* plane(int channel) const { return data_.data() + index(0, 0, channel); }

  /// Where the image lies in a larger one, and that one's size: a crop's place. Equal to the image's own by
  /// default.
  struct Window {
    int x = 0;
    int y = 0;
    int full_width = 0;
    int full_height = 0;
  };
  Window window;

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

}  // namespace facet
