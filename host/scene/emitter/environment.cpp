#include <cmath>

#include "image/files.h"
#include "scene/emitter/readers.h"

namespace facet {

namespace {

Color texel_of(const Image& image, int x, int y, const std::array<int, 3>& channels) {
  return {image.at(x, y, channels[0]), image.at(x, y, channels[1]), image.at(x, y, channels[2])};
}

/// The colour channels of an environment image; a luminance image serves for all three.
std::array<int, 3> color_channels(const Image& image, PropertyReader& properties, const std::string& file) {
  const int y = image.find_channel("Y");
  std::array<int, 3> channels{image.find_channel("R"), image.find_channel("G"), image.find_channel("B")};
  for (int& c : channels) c = c < 0 ? y : c;
  if (channels[0] < 0 || channels[1] < 0 || channels[2] < 0)
    properties.fail("filename", fmt::format("{} has no channels R, G and B", file));
  return channels;
}

}  // namespace

EnvironmentEmitter read_environment_emitter(PropertyReader& properties) {
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
  EnvironmentEmitter e{image.width(), image.height(), {}};
  // The lab's renderer divides the map by 255 whatever it holds; its scenes make up for it in `radiance`.
  const Color factor = linear ? radiance : radiance / 255.0F;
  for (int y = 0; y < e.height; ++y) {
    for (int x = 0; x < e.width; ++x) {
      const Color texel = texel_of(image, x, y, channels) * factor;
      const bool valid = glm::all(glm::greaterThanEqual(texel, Color(0))) &&
                         glm::all(glm::lessThanEqual(texel, Color(largest_radiance)));
      if (!valid) {
        properties.fail(
            "filename",
            fmt::format("{}: pixel ({}, {}) is negative, not finite or more than 1e30", path.string(), x, y));
      }
      e.texels.push_back(texel);
    }
  }
  return e;
}

}  // namespace facet
