#pragma once
// Checksums of parts, by which damage to a file is noticed.
#include <facet/film.h>

#include <string>

namespace facet {

inline constexpr const char* checksum_key = "facet.checksum";

/// CRC-32 (ISO 3309), eight hexadecimal digits, of what makes an image a part: its channels sum.*,
/// square.*, samples* and state.*, and its metadata facet.* but for the checksum itself; each by
/// name and content, sorted by name.
[[nodiscard]] std::string checksum(const Image& image);

/// Adds it to the image's metadata, or renews it there.
void add_checksum(Image& image);

/// Throws InputError, which begins with the name, where the image has another checksum than its
/// metadata say.
void check_checksum(const Image& image, const std::string& name);

}  // namespace facet
