#pragma once
// Exit codes of the program, which scripts depend on.
#include <facet/error.h>

namespace facet::cli {

enum class ExitCode : int {
  done = 0,
  check_failed = 1,   ///< a comparison or test did not hold
  bad_input = 2,      ///< wrong usage, bad scene, unreadable or unwritable file
  device_failed = 3,  ///< no usable device, or it failed
  interrupted = 130,
};

/// The exit code of a program that an error ends.
[[nodiscard]] constexpr ExitCode exit_code_of(ErrorKind kind) {
  return kind == ErrorKind::device ? ExitCode::device_failed : ExitCode::bad_input;
}

}  // namespace facet::cli
