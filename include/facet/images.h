#pragma once
// Image files, comparing and merging.
#include <facet/film.h>

#include <filesystem>
#include <string>
#include <vector>

namespace facet {

/// How an EXR is packed: to be small, or not at all, which is faster to write and to read.
enum class ExrCompression { zip, uncompressed };

struct WriteOptions {
  ExrCompression compression = ExrCompression::zip;
  float exposure = 0;     ///< of PNGs: stops, a factor of 2^exposure
  bool variance = false;  ///< of EXRs: variance channels; the film must have squares
  bool error = false;     ///< of EXRs: channels of each pixel's standard error; likewise
  bool part = false;      ///< of EXRs: the sums, too, so that merge_parts can join it with others
};

/// Writes an EXR or a PNG, as the name's extension says; whole or not at all. Throws Error where it
/// cannot.
void write_image(const std::filesystem::path& path, const Film& film,
                 const WriteOptions& options = {});
void write_image(const std::filesystem::path& path, const Image& image,
                 const WriteOptions& options = {});

/// Reads an EXR, PNG, JPEG or Radiance HDR image, as its first bytes tell; codes are decoded from
/// sRGB. Throws Error where the file is missing, unreadable or damaged.
[[nodiscard]] Image read_image(const std::filesystem::path& path);

/// Joins parts of one render, in files that `write_image` with `part`, or `facet render
/// --sample-range`, have written. Throws Error where they are not of one render, hold the same
/// samples, or leave a gap.
[[nodiscard]] Film merge_parts(const std::vector<std::string>& files);

/// Errors of an image against a reference.
struct ComparisonSummary {
  double mean_ratio = 0;      ///< mean luminance over that of the reference; of black over black 1
  double max_abs = 0;         ///< largest difference of a channel
  double rmse = 0;            ///< root of the mean squared difference
  double relmse = 0;          ///< mean squared difference relative to the reference
  double flip = 0;            ///< mean LDR-FLIP
  double hdr_flip = 0;        ///< mean HDR-FLIP
  double identical = 0;       ///< share of pixels equal in all bits
  std::size_t nonfinite = 0;  ///< pixels that are not finite in either
};

/// Throws Error unless both have R, G and B, the same size and the same place in their frame.
[[nodiscard]] ComparisonSummary compare(const Image& image, const Image& reference);

}  // namespace facet
