#pragma once
// The table of extremes: lines for people, JSON, and a page.
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "extremes/extremes.h"

namespace facet::report {

/// One line, ended; where the row fails also the input, and what is lost.
[[nodiscard]] std::string text_of(const extremes::Row& row);

/// How many rows hold, are argued and fail; a line.
[[nodiscard]] std::string summary_of(const extremes::Table& table);

/// {"device", "driver", "version", "quick", "complete", "rows"}; a worst of null is infinite.
[[nodiscard]] nlohmann::ordered_json extremes_json(const extremes::Table& table);

/// A page that needs nothing else. Throws InputError where the file cannot be written.
void write_extremes_page(const std::string& path, const extremes::Table& table);

}  // namespace facet::report
