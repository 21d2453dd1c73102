#pragma once
// Errors, as the rooms throw them.
#include <facet/error.h>
#include <fmt/format.h>

#include <string>

#include "core/text.h"

namespace facet {

/// Bad usage, a bad scene, or a file that cannot be read or written.
class InputError : public Error {
 public:
  explicit InputError(const std::string& message) : Error(ErrorKind::input, message) {}
  InputError(const SourceLocation& where, const std::string& message)
      : Error(ErrorKind::input, where, message) {}
};

/// No usable device, or one that failed.
class DeviceError : public Error {
 public:
  explicit DeviceError(const std::string& message) : Error(ErrorKind::device, message) {}
};

}  // namespace facet
