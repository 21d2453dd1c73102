#include "image/color_image.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/text.h"

namespace facet {

namespace {

/// The channels of a layer's colour, by names of any case: R, G and B, or a luminance Y that serves
/// for all three; -1 where there is none. layer: "" or "ViewLayer.Combined.".
std::array<int, 3> channels_of_layer(const Image& image, const std::string& layer) {
  std::array<int, 3> channels{-1, -1, -1};
  int luminance = -1;
  for (int c = 0; c < static_cast<int>(image.channels().size()); ++c) {
    const std::string name = lower_case(image.channels()[static_cast<std::size_t>(c)]);
    if (name == layer + "r" || name == layer + "red") channels[0] = c;
    if (name == layer + "g" || name == layer + "green") channels[1] = c;
    if (name == layer + "b" || name == layer + "blue") channels[2] = c;
    if (name == layer + "y") luminance = c;
  }
  for (int& c : channels) c = c < 0 ? luminance : c;
  return channels;
}

/// Those without a layer, else those of the first layer that has some.
std::array<int, 3> color_channels(const Image& image, const std::filesystem::path& path) {
  std::vector<std::string> layers{""};
  for (const std::string& name : image.channels()) {
    const std::size_t dot = name.rfind('.');
    if (dot != std::string::npos) layers.push_back(lower_case(name.substr(0, dot + 1)));
  }
  for (const std::string& layer : layers) {
    const std::array<int, 3> channels = channels_of_layer(image, layer);
    if (std::ranges::all_of(channels, [](int c) { return c >= 0; })) return channels;
  }
  throw InputError(fmt::format("{}: has no channels R, G and B, but {}", path.string(),
                               fmt::join(image.channels(), ", ")));
}

}  // namespace

ColorImage color_image(const Image& image, const std::filesystem::path& path) {
  const std::array<int, 3> channels = color_channels(image, path);
  const ImageWindow& window = image.window;
  ColorImage result{window.full_width, window.full_height, {}};
  const auto width = static_cast<std::size_t>(result.width);
  result.pixels.resize(width * static_cast<std::size_t>(result.height), Color(0));
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const int column = x + window.x;
      const int row = y + window.y;
      if (column < 0 || column >= result.width || row < 0 || row >= result.height) continue;
      result.pixels[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)] = {
          image.at(x, y, channels[0]), image.at(x, y, channels[1]), image.at(x, y, channels[2])};
    }
  }
  return result;
}

}  // namespace facet
