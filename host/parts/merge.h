#pragma once
// Parts of one render, joined.
#include <optional>

#include "parts/part_file.h"

namespace facet {

/// Parts that belong together, sorted by their samples: sums depend on the order of their terms,
/// and that on a command line must not matter.
struct PartSet {
  std::vector<PartFile> parts;
  SampleRanges samples;  ///< of all parts

  /// What the hull of the samples has and no part holds.
  [[nodiscard]] SampleRanges missing() const { return samples.missing_in(samples.hull()); }
};

/// Reads the headers alone: whatever does not fit together is told before any pixel is read. Throws
/// InputError for files that are not of one render, or that hold the same samples.
[[nodiscard]] PartSet open_parts(const std::vector<std::string>& files);

/// Throws InputError where a part holds samples outside the range.
void check_inside(const PartSet& set, const SampleRange& range);

/// Throws InputError where no part holds some sample of the range; without a range: of the hull.
void check_whole(const PartSet& set, const std::optional<SampleRange>& range);

/// The film of all samples, with squares if all parts have them. Its record is that of the first
/// part, with all samples, devices, drivers, and the sum of the seconds.
[[nodiscard]] Film merge(const PartSet& set);

}  // namespace facet
