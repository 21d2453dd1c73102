#pragma once
// Text: numbers, names, lists.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace facet {

/// The whole text as a finite number, independent of the locale; nothing if there is anything else
/// in it.
[[nodiscard]] std::optional<double> parse_real(std::string_view text);

/// The whole text as an integer that fits.
[[nodiscard]] std::optional<long long> parse_integer(std::string_view text);

/// The parts between commas and blanks, none of them empty.
[[nodiscard]] std::vector<std::string_view> split_list(std::string_view text);

/// The candidate most like `name`, by edit distance, if any is near enough to be meant.
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view name,
                                                      std::span<const std::string> candidates);

/// " ; did you mean ...?" for an error message, or nothing.
[[nodiscard]] std::string did_you_mean(std::string_view name,
                                       std::span<const std::string> candidates);

/// Without the blanks and ends of lines around it.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// A to Z as a to z; other bytes stay.
[[nodiscard]] std::string lower_case(std::string text);

/// Text from outside as it may stand in a message, on a terminal or in a report: control characters
/// as
/// `\x1b`, and of more than `most` bytes the beginning and "...".
[[nodiscard]] std::string printable(std::string_view text, std::size_t most = 2000);

/// 1234567 as "1.23 M", for figures that people read.
[[nodiscard]] std::string with_unit_prefix(double value);

}  // namespace facet
