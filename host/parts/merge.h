#pragma once
// Parts of one render, joined.
#include <optional>

#include "parts/part_file.h"

namespace facet {

/// Which pixels and samples a file holds.
struct PartEntry {
  std::string file;
  Crop pixels;
  SampleRanges samples;
  bool has_squares = false;
};

/// The samples that all parts of some pixels hold together.
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

/// Throws InputError where a part holds samples outside the range.
void check_inside(const PartSet& set, const SampleRange& range);

/// Throws InputError where the parts leave pixels of their rectangle out, or tiles hold different
/// samples; and, unless gaps are allowed, where a share of the division or some sample of the range
/// (without one: of whole_samples) is missing.
void check_whole(const PartSet& set, const std::optional<SampleRange>& range, bool allow_gaps);

/// The film of all samples, with squares if all parts have them. As many parts are read at a time as
/// there are threads: it takes the memory of the film and of those. Throws InputError for damaged parts.
[[nodiscard]] Film merge(const PartSet& set);

}  // namespace facet
