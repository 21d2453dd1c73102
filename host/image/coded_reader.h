#pragma once
// What reading a PNG and a JPEG have in common.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>

#include "core/error.h"
#include "core/input_file.h"
#include "image/files.h"

namespace facet {

/// The samples of a file by a Reader of its format's library, which has read_header(FILE*) and
/// read_pixels(bytes), false on failure; width(), height(), sample_size() in bytes, once the header
/// is read; values_per_byte(), the most that compression can have made of one; and message().
/// format: `PNG`, for messages. Throws InputError where the file is missing, unreadable, damaged or
/// too large.
template <typename Reader>
[[nodiscard]] CodedImage read_coded(const std::filesystem::path& path, std::string_view format) {
  check_input_file(path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(path.c_str(), "rb"),
                                                           &std::fclose);
  if (!in)
    throw InputError(fmt::format("{}: cannot read: {}", path.string(), std::strerror(errno)));
  Reader reader;
  const auto expect = [&](bool read) {
    if (!read)
      throw InputError(
          fmt::format("{}: not a readable {} image: {}", path.string(), format, reader.message()));
  };
  expect(reader.read_header(in.get()));
  check_file_image_size(path, reader.width(), reader.height(), 3, reader.values_per_byte());
  CodedImage image{static_cast<int>(reader.width()), static_cast<int>(reader.height()), 255, {}};
  const std::size_t samples = 3 * static_cast<std::size_t>(reader.width()) * reader.height();
  std::vector<std::uint8_t> pixels(samples * reader.sample_size());
  expect(reader.read_pixels(pixels));
  if (reader.sample_size() == 1) {
    image.codes.assign(pixels.begin(), pixels.end());
  } else {
    image.largest = 65535;
    image.codes.resize(samples);
    std::memcpy(image.codes.data(), pixels.data(), pixels.size());
  }
  return image;
}

}  // namespace facet
