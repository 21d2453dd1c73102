#pragma once
// Printing that never throws. A log that is full, or an output that nobody reads any more, is no
// reason to lose a render: what cannot be written is dropped, and main() asks at the end whether
// all of standard output was.
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace facet {

/// To standard error.
template <typename... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  const std::string text = fmt::format(format, std::forward<Args>(args)...);
  (void)std::fwrite(text.data(), 1, text.size(), stderr);
}

/// To standard output.
template <typename... Args>
void put(fmt::format_string<Args...> format, Args&&... args) {
  const std::string text = fmt::format(format, std::forward<Args>(args)...);
  (void)std::fwrite(text.data(), 1, text.size(), stdout);
}

}  // namespace facet
