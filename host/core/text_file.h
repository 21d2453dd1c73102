#pragma once
// Reports: text to a file, or to standard output.
#include <string>

namespace facet {

/// Writes the text to a file, whole or not at all; "-" is standard output. Throws InputError if it
/// cannot.
void write_text(const std::string& target, const std::string& text);

/// The same, after what the file holds already.
void append_text(const std::string& target, const std::string& text);

}  // namespace facet
