#pragma once
// Parts that belong together: which pixels and samples their files hold.
#include "parts/part_file.h"

namespace facet {

/// Which pixels and samples a file holds.
struct PartEntry {
  std::string file;
  Crop pixels;
  SampleRanges samples;
  bool has_squares = false;
};

/// The samples that the parts of some pixels hold together; each of those has all of the pixels.
struct Tile {
  Crop pixels;
  SampleRanges samples;
};

/// Parts that belong together, sorted by their pixels, then by their samples: sums depend on the
/// order of their terms, and that on a command line must not matter.
struct PartSet {
  std::vector<PartEntry> parts;
  std::vector<Tile> tiles;  ///< sorted by their corners, apart from one another
  ImageSize size;           ///< of the whole image
  /// That of the first part in order, with all devices, drivers and seconds; with the division that
  /// all parts are shares of, or none.
  RenderRecord record;

  /// The least rectangle with the pixels of all parts.
  [[nodiscard]] Crop pixels() const;
  /// Samples likewise.
  [[nodiscard]] SampleRange whole_samples() const;
  /// Those of them that every tile holds.
  [[nodiscard]] SampleRanges samples() const;
};

/// Reads the headers alone: whatever does not fit together is told before any pixel is read. Throws
/// InputError for files that are not of one render, or that hold the same samples of the same
/// pixels, and for an empty list.
[[nodiscard]] PartSet open_parts(const std::vector<std::string>& files);

}  // namespace facet
