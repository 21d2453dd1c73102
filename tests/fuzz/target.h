#pragma once
// What fuzz targets have in common: bytes become a file, and whatever is thrown must be a
// facet::Error of bad input.
#include <facet/error.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>

namespace facet::fuzz {

/// A folder of its own, in memory where there is such a place, with what inputs may refer to.
class Workplace {
 public:
  Workplace();
  ~Workplace();
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  /// Writes a file of that name.
  std::filesystem::path write(const std::string& name, std::string_view bytes) const;

 private:
  std::filesystem::path path_;
};

/// One for the whole process.
[[nodiscard]] const Workplace& workplace();

/// Calls `read`; whatever it throws but an Error of ErrorKind::input ends the process.
template <typename Read>
void expect_input_errors(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input) std::abort();
    // Messages are one line without control characters.
    for (const char c : std::string_view(error.what())) {
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) std::abort();
    }
  }
}

[[nodiscard]] inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};  // NOLINT(*-reinterpret-cast)
}

}  // namespace facet::fuzz

/// What libFuzzer calls with every input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
