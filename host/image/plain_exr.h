#pragma once
// The pixels of the EXR files that facet itself writes, read faster than OpenEXR's classes do.
#include <facet/film.h>

#include <filesystem>

namespace facet {

/// Fills the planes of an image, whose size, window and channels are those of the file, where that
/// holds scan lines of 32-bit channels without subsampling, one part, unpacked or packed by ZIP.
/// Channels whose names begin with word_prefix have to be integers, all others floats. Returns
/// false, with pixels left undefined, for any other file and for one that is damaged, which
/// OpenEXR's classes can say more about.
[[nodiscard]] bool read_plain_exr(const std::filesystem::path& path, Image& image);

}  // namespace facet
