#include <algorithm>
#include <array>
#include <cctype>

#include "image/files.h"
#include "scene/emitter/readers.h"

namespace facet {

namespace {

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// The channels of a layer's colour, by names of any case: R, G and B, or a luminance Y that serves for all
/// three; -1 where there is none. layer: "" or "ViewLayer.Combined.".
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

/// The colour channels of an environment image: those without a layer, else those of the first layer that has
/// some.
std::array<int, 3> color_channels(const Image& image, PropertyReader& properties, const std::string& file) {
  std::vector<std::string> layers{""};
  for (const std::string& name : image.channels()) {
    const std::size_t dot = name.rfind('.');
    if (dot != std::string::npos) layers.push_back(lower_case(name.substr(0, dot + 1)));
  }
  for (const std::string& layer : layers) {
    const std::array<int, 3> channels = channels_of_layer(image, layer);
    if (std::ranges::all_of(channels, [](int c) { return c >= 0; })) return channels;
  }
  properties.fail("filename", fmt::format("{} has no channels R, G and B, but {}", file,
                                          fmt::join(image.channels(), ", ")));
}

/// Values that no light has become what is nearest: NaN and what is negative 0, what is infinite or too large
/// the largest. Counts them.
Color valid_texel(const Color& texel, std::size_t& mended) {
  Color valid = texel;
  for (int c = 0; c < 3; ++c) {
    if (!(texel[c] >= 0)) valid[c] = 0;
    if (texel[c] > largest_radiance) valid[c] = largest_radiance;
  }
  if (valid != texel) ++mended;
  return valid;
}

}  // namespace

EnvironmentEmitter read_environment_emitter(PropertyReader& properties, Diagnostics& diagnostics) {
  const std::string filename = properties.string("filename", "");
  const Color radiance = properties.radiance("radiance", Color(1));
  const bool linear = properties.choice("encoding", {"msa", "linear"}) == "linear";
  if (filename.empty()) return {1, 1, {radiance}};
  const std::filesystem::path path = properties.xml().path().parent_path() / filename;
  const Image image = [&] {
    try {
      return read_exr(path);
    } catch (const InputError& e) {
      throw InputError(properties.location(), e.what());
    }
  }();
  const std::array<int, 3> channels = color_channels(image, properties, path.string());
  // The display window is the whole sphere; what the file leaves out of it is black.
  const Image::Window& window = image.window;
  EnvironmentEmitter e{window.full_width, window.full_height, {}};
  e.texels.resize(static_cast<std::size_t>(e.width) * static_cast<std::size_t>(e.height), Color(0));
  // The lab's renderer divides the map by 255 whatever it holds; its scenes make up for it in `radiance`.
  const Color factor = linear ? radiance : radiance / 255.0F;
  std::size_t mended = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const int column = x + window.x;
      const int row = y + window.y;
      if (column < 0 || column >= e.width || row < 0 || row >= e.height) continue;
      const Color value(image.at(x, y, channels[0]), image.at(x, y, channels[1]),
                        image.at(x, y, channels[2]));
      e.texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(e.width) +
               static_cast<std::size_t>(column)] = valid_texel(value * factor, mended);
    }
  }
  if (mended > 0) {
    diagnostics.warn(
        properties.location(),
        fmt::format(
            "{}: {} texels are negative, not finite or more than 1e30, and were brought to what is nearest",
            path.string(), mended));
  }
  return e;
}

}  // namespace facet
