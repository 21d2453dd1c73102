#include "scene/texture/texture.h"

#include <algorithm>

#include "image/files.h"

namespace facet {

namespace {

std::array<float, 256> make_linear_values() {
  std::array<float, 256> values{};
  for (std::size_t i = 0; i < values.size(); ++i)
    values.at(i) = static_cast<float>(static_cast<double>(i) / 255);
  return values;
}

/// Calls body(Color) for every texel.
template <typename Body>
void for_each_texel(const BitmapTexture& t, const Body& body) {
  for (std::size_t i = 0; i < std::max(t.texels.size(), t.colors.size()); ++i)
    body(t.factor * texel(t, i));
}

}  // namespace

const std::array<float, 256>& byte_values(bool srgb) {
  static const std::array<float, 256> linear = make_linear_values();
  return srgb ? srgb_values() : linear;
}

Color texel(const BitmapTexture& texture, std::size_t index) {
  if (!texture.colors.empty()) return texture.colors[index];
  const std::array<float, 256>& values = byte_values(texture.srgb);
  const std::uint32_t bytes = texture.texels[index];
  return {values[bytes & 255U], values[bytes >> 8U & 255U], values[bytes >> 16U & 255U]};
}

Color mean(const Texture& texture) {
  if (const auto* checker = std::get_if<CheckerTexture>(&texture))
    return (checker->even() + checker->odd()) / 2.0F;
  const auto& bitmap = std::get<BitmapTexture>(texture);
  dvec3 sum(0);
  for_each_texel(bitmap, [&](const Color& c) { sum += dvec3(c); });
  return Color(sum / static_cast<double>(
                         std::max({std::size_t{1}, bitmap.texels.size(), bitmap.colors.size()})));
}

float maximum(const Texture& texture) {
  Color most(0);
  if (const auto* checker = std::get_if<CheckerTexture>(&texture)) {
    most = glm::max(checker->even(), checker->odd());
  } else {
    for_each_texel(std::get<BitmapTexture>(texture),
                   [&](const Color& c) { most = glm::max(most, c); });
  }
  return std::max({most.r, most.g, most.b});
}

}  // namespace facet
