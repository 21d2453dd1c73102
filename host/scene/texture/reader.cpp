#include "scene/texture/reader.h"

#include <cmath>

#include "core/text.h"
#include "image/files.h"
#include "scene/plugins.h"

namespace facet {

namespace {

CheckerTexture read_checker(PropertyReader& p) {
  CheckerTexture t;
  t.scale_x = p.integer("scalex", 1, 1, 1 << 20);
  t.scale_y = p.integer("scaley", 1, 1, 1 << 20);
  if (p.has("color")) t.first = t.second = p.radiance("color", t.first);
  t.first = p.radiance("color1", t.first);
  t.second = p.radiance("color2", t.second);
  return t;
}

float read_scale(PropertyReader& p, const std::string& name) {
  const double scale = p.number(name, 1);
  if (!(std::abs(scale) <= 1 << 20))
    p.fail(name, fmt::format("is {:g}, but must be -1048576 to 1048576", scale));
  return static_cast<float>(scale);
}

BitmapTexture read_bitmap(PropertyReader& p) {
  BitmapTexture t;
  const std::string filename = p.string("filename", "");
  if (filename.empty()) p.fail("filename", "is missing");
  t.factor = p.radiance("color", Color(1));
  t.scale_x = read_scale(p, "scalex");
  t.scale_y = read_scale(p, "scaley");
  t.srgb = p.boolean("srgb", false);
  const std::filesystem::path path = p.xml().path().parent_path() / filename;
  try {
    const ByteImage image = read_png_bytes(path);
    t.width = image.width;
    t.height = image.height;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
      t.texels.push_back(image.pixels[i] | std::uint32_t{image.pixels[i + 1]} << 8U |
                         std::uint32_t{image.pixels[i + 2]} << 16U);
    }
  } catch (const InputError& e) {
    p.fail("filename", fmt::format("cannot be used: {}", e.what()));
  }
  return t;
}

}  // namespace

Texture read_texture(PropertyReader& properties) {
  if (properties.type() == "checker") return read_checker(properties);
  if (properties.type() == "textmap") return read_bitmap(properties);
  fail_unknown_type(properties, "texture");
}

}  // namespace facet
