#pragma once
// Encodings of XML files.
#include <string>

namespace facet {

/// The text of an XML file as UTF-8 without a byte order mark: from UTF-16 or UTF-32, with a mark
/// or beginning with `<`, or from ISO 8859-1, where its declaration says so. What is not a
/// character becomes U+FFFD.
[[nodiscard]] std::string to_utf8(std::string bytes);

}  // namespace facet
