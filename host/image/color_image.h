#pragma once
// The colours of an image whose channels have the names of some program.
#include <facet/film.h>

#include <filesystem>
#include <vector>

#include "core/maths.h"

namespace facet {

struct ColorImage {
  int width = 0;
  int height = 0;
  std::vector<Color> pixels;  ///< rows from the top
};

/// Colours of the whole display window, black where the image's pixels leave it out: the channels
/// R, G and B, or Red, Green and Blue, in any case, or a luminance Y that serves for all three,
/// without a layer or of the first layer (`ViewLayer.Combined.R`) that has them. Throws InputError
/// that names the channels where there are none such.
[[nodiscard]] ColorImage color_image(const Image& image, const std::filesystem::path& path);

}  // namespace facet
