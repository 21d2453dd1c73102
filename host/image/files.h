#pragma once
// Image files. Writers write to a temporary name beside the target and rename it: a failed write never
// destroys the file that was there.
#include <array>
#include <cstdint>
#include <filesystem>

#include "image/image.h"

namespace facet {

/// Reads all channels of a scan-line or tiled EXR as floats, and the text attributes of its header.
/// Throws InputError where the file is missing, unreadable or damaged.
[[nodiscard]] Image read_exr(const std::filesystem::path& path);

/// Reads a PNG as linear R, G and B: its samples as sRGB codes whatever else it says of them, without alpha,
/// 16 bits rounded to 8. Throws InputError where the file is missing, unreadable, damaged or of 16 bits a
/// channel.
[[nodiscard]] Image read_png(const std::filesystem::path& path);

/// A PNG's bytes.
struct ByteImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  ///< R, G, B; rows from the top
};

/// read_png without the decoding of sRGB.
[[nodiscard]] ByteImage read_png_bytes(const std::filesystem::path& path);

/// Linear values of the 256 codes of sRGB, IEC 61966-2-1.
[[nodiscard]] const std::array<float, 256>& srgb_values();

/// Reads an EXR or a PNG, by its extension.
[[nodiscard]] Image read_image(const std::filesystem::path& path);
/// What stands in the header of an EXR.
struct ExrHeader {
  int width = 0;
  int height = 0;
  Image::Window window;
  std::vector<std::string> channels;
  std::vector<std::pair<std::string, std::string>> metadata;
};

/// Reads the header alone. Throws like read_exr, but for damage to what follows the header.
[[nodiscard]] ExrHeader read_exr_header(const std::filesystem::path& path);

/// Writes 32-bit float channels, ZIP-compressed, with the image's metadata as text attributes.
void write_exr(const std::filesystem::path& path, const Image& image);

/// Writes the channels R, G and B as 8-bit sRGB. exposure: stops, a factor of 2^exposure before encoding.
void write_png(const std::filesystem::path& path, const Image& image, float exposure);

/// Throws InputError unless there is a file at path.
void check_readable(const std::filesystem::path& path);

/// Throws InputError for sizes that are taken for a damaged header.
void check_file_image_size(const std::filesystem::path& path, long long width, long long height);

/// Throws InputError unless a file can be written at path; leaves nothing behind and changes nothing.
void check_writable(const std::filesystem::path& path);

}  // namespace facet
