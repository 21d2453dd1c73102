#pragma once
// Linear images as pages hold them (pages/images.js).
#include <facet/film.h>

#include <span>
#include <string>

namespace facet::report {

/// R, G and B of each pixel as 16-bit floats, little-endian, divided by a scale; in base64.
[[nodiscard]] std::string packed_halves(const Image& image, float scale);

/// The power of two that brings the images into the range of 16-bit floats, best at 1 unless they
/// need another.
[[nodiscard]] float half_scale(std::span<const Image* const> images);

}  // namespace facet::report
