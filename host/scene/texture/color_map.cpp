#include "scene/texture/color_map.h"

namespace facet {

void scale_and_clamp(ColorImage& image, const Color& factor, const std::filesystem::path& path,
                     const SourceLocation& where, Diagnostics& diagnostics) {
  std::size_t mended = 0;
  for (Color& texel : image.pixels) {
    const Color scaled = texel * factor;
    for (int c = 0; c < 3; ++c)
      texel[c] = scaled[c] >= 0 ? std::min(scaled[c], largest_radiance) : 0.0F;
    if (texel != scaled) ++mended;
  }
  if (mended > 0) {
    diagnostics.warn(where, fmt::format("{}: {} texels are negative, not finite or more than 1e30, "
                                        "and were brought to what is nearest",
                                        path.string(), mended));
  }
}

}  // namespace facet
