#include "scene/texture/reader.h"

#include <cmath>

#include "core/text.h"
#include "image/files.h"
#include "scene/plugin/parameter_reader.h"
#include "scene/plugins.h"
#include "scene/texture/color_map.h"

namespace facet {

namespace {

/// Bytes stay bytes; more bits become floats.
void load_codes(const CodedImage& image, BitmapTexture& t) {
  t.width = image.width;
  t.height = image.height;
  const std::vector<std::uint16_t>& codes = image.codes;
  const auto decode = [&](std::uint16_t code) {
    const double share = static_cast<double>(code) / image.largest;
    return static_cast<float>(t.srgb ? decode_srgb(share) : share);
  };
  for (std::size_t i = 0; i < codes.size(); i += 3) {
    if (image.largest == 255) {
      t.texels.push_back(codes[i] | std::uint32_t{codes[i + 1]} << 8U |
                         std::uint32_t{codes[i + 2]} << 16U);
    } else {
      t.colors.emplace_back(decode(codes[i]), decode(codes[i + 1]), decode(codes[i + 2]));
    }
  }
}

/// Throws InputError without a place in the scene.
void load_texels(const std::filesystem::path& path, const SourceLocation& where,
                 Diagnostics& diagnostics, BitmapTexture& t) {
  const ImageFormat format = image_format(path);
  if (format == ImageFormat::png) return load_codes(read_png(path), t);
  if (format == ImageFormat::jpeg) return load_codes(read_jpeg(path), t);
  ColorImage image = color_image(read_image(path), path);
  scale_and_clamp(image, Color(1), path, where, diagnostics);
  t.width = image.width;
  t.height = image.height;
  t.colors = std::move(image.pixels);
}

BitmapTexture read_bitmap(PropertyReader& p, Diagnostics& diagnostics) {
  auto t = read_parameters<BitmapTexture>(p);
  const std::filesystem::path path = p.xml().path().parent_path() / t.filename;
  try {
    load_texels(path, p.location(), diagnostics, t);
  } catch (const InputError& e) {
    p.fail("filename", fmt::format("cannot be used: {}", e.what()));
  }
  return t;
}

}  // namespace

Texture read_texture(PropertyReader& properties, Diagnostics& diagnostics) {
  if (properties.type() == "checker") return read_parameters<CheckerTexture>(properties);
  if (properties.type() == "textmap") return read_bitmap(properties, diagnostics);
  fail_unknown_type(properties, "texture");
}

BitmapTexture read_material_map(const std::filesystem::path& path, const SourceLocation& where,
                                Diagnostics& diagnostics) {
  BitmapTexture t;
  t.srgb = true;
  t.scale_x = -1;
  load_texels(path, where, diagnostics, t);
  return t;
}

}  // namespace facet
