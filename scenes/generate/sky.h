#pragma once

#include <filesystem>

namespace facet::generate {

/// Writes a clear sky with sun as a lat-long OpenEXR of half floats, in the layout that Nori's
/// `environment` emitter reads: direction (cos φ sin θ, cos θ, sin φ sin θ), y up, lies at column
/// (1 - φ/2π) W and row (1 - θ/π) H, so that the zenith is the last row. The values are radiances:
/// a scene with `radiance` 255 undoes the lab's division by 255.
void write_sky(const std::filesystem::path& file);

}  // namespace facet::generate
