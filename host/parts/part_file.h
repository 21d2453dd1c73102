#pragma once
// EXR files that hold a part of a render: what their headers say, and whether two belong together.
#include <string>

#include "image/files.h"

namespace facet {

struct PartFile {
  std::string file;
  ExrHeader header;
  RenderRecord record;

  /// Whether it holds sums of squares.
  [[nodiscard]] bool has_squares() const { return has_channel("square.R"); }
  [[nodiscard]] bool has_channel(const std::string& name) const;
  /// Of the whole image.
  [[nodiscard]] Crop pixels() const;
  /// Its pixels' sums, with the record. Throws InputError where they are damaged.
  [[nodiscard]] Film read() const;
};

/// Reads a part's header. Throws InputError for a file that is no part or whose render was
/// interrupted.
[[nodiscard]] PartFile open_part(const std::string& file);

/// The record of a header. Throws InputError where the header lacks an entry, or has one that
/// cannot be.
[[nodiscard]] RenderRecord read_record(const std::string& file, const ExrHeader& header);

/// Throws InputError, which names the difference, unless both files are of one render of the same
/// scene; their pixels and samples may be others.
void check_same_render(const PartFile& part, const PartFile& first);

/// Throws InputError unless both files hold the same pixels.
void check_same_pixels(const PartFile& part, const PartFile& first);

}  // namespace facet
