#pragma once
// Reports: text to a file, or to standard output.
#include <string>

namespace facet {

/// Writes the text to a file, whole or not at all; "-" is standard output. Throws InputError if it
/// cannot.
void write_text(const std::string& target, const std::string& text);

/// Writes the text behind what the file holds already. Throws InputError if it cannot.
void append_text(const std::string& target, const std::string& text);

}  // namespace facet
