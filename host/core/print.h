#pragma once
// Printing that never throws for want of a reader. A log that is full, or an output that nobody
// reads any more, is no reason to lose a render: what cannot be written is dropped, and main() asks
// at the end whether all of standard output was.
//
// Texts that are printed may come from strangers' files. Their control characters, which command a
// terminal and end lines, appear as `\x1b`; those of the formats themselves, which are ours, stay.
#include <fmt/format.h>

#include <cstdio>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/text.h"

namespace facet {

namespace printing {

/// What fmt::join() makes.
template <typename Value>
inline constexpr bool is_join = false;
template <typename Iterator, typename Sentinel>
inline constexpr bool is_join<fmt::join_view<Iterator, Sentinel, char>> = true;

/// A value as it may be printed: texts without control characters, others as they are.
template <typename Value>
decltype(auto) shown(const Value& value) {
  constexpr auto all = std::numeric_limits<std::size_t>::max() / 2;
  if constexpr (std::is_convertible_v<const Value&, std::string_view>) {
    return printable(std::string_view(value), all);
  } else if constexpr (is_join<Value>) {
    return printable(fmt::vformat("{}", fmt::make_format_args(value)), all);
  } else {
    return (value);
  }
}

/// Newer versions of fmt want arguments that have a name.
template <typename... Values>
std::string formatted(fmt::string_view format, const Values&... values) {
  return fmt::vformat(format, fmt::make_format_args(values...));
}

template <typename... Args>
void print(std::FILE* stream, fmt::format_string<Args...> format, const Args&... args) {
  const std::string text = formatted(fmt::string_view(format), shown(args)...);
  (void)std::fwrite(text.data(), 1, text.size(), stream);
}

}  // namespace printing

/// To standard error.
template <typename... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  printing::print<Args...>(stderr, format, args...);
}

/// To standard output.
template <typename... Args>
void put(fmt::format_string<Args...> format, Args&&... args) {
  printing::print<Args...>(stdout, format, args...);
}

/// A text of several lines to standard output: ends of lines stay, too.
void put_text(std::string_view text);

}  // namespace facet
