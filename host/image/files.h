#pragma once
// Image files. Writers write to a temporary name beside the target and rename it: a failed write
// never destroys the file that was there.
#include <facet/images.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>

namespace facet {

/// What is read. A file's first bytes tell, whatever its name says.
enum class ImageFormat { exr, png, jpeg, hdr };

/// Of a file to write, by its extension in any case: EXR or PNG. Throws InputError for any other.
[[nodiscard]] ImageFormat output_format(const std::filesystem::path& path);

/// Throws InputError where the file is missing or of another kind, which it names.
[[nodiscard]] ImageFormat image_format(const std::filesystem::path& path);

/// Reads all channels of a scan-line or tiled EXR as floats, and the text attributes of its header.
/// Of several parts those are read that are not deep and of the size of the first such one; the
/// channels of others than that one get the part's name as a layer, `part.R`. Throws InputError
/// where the file is missing, unreadable or damaged.
[[nodiscard]] Image read_exr(const std::filesystem::path& path);

/// Samples of a PNG or a JPEG as they stand in the file.
struct CodedImage {
  int width = 0;
  int height = 0;
  int largest = 255;                 ///< code: 255 or 65535
  std::vector<std::uint16_t> codes;  ///< R, G, B; rows from the top
};

/// Without alpha, grey as three equal samples, and whatever the file says of its gamma and colours.
/// Throws InputError where the file is missing, unreadable or damaged.
[[nodiscard]] CodedImage read_png(const std::filesystem::path& path);
/// The same of a JPEG; its orientation (EXIF) is left aside.
[[nodiscard]] CodedImage read_jpeg(const std::filesystem::path& path);

/// Reads a Radiance HDR image (RGBE, in runs or not) as R, G and B. Throws InputError likewise.
[[nodiscard]] Image read_hdr(const std::filesystem::path& path);

/// The linear value of an sRGB code in [0, 1], IEC 61966-2-1.
[[nodiscard]] double decode_srgb(double code);
/// Linear values of the 256 codes of a byte.
[[nodiscard]] const std::array<float, 256>& srgb_values();

/// What stands in the header of an EXR.
struct ExrHeader {
  int width = 0;
  int height = 0;
  ImageWindow window;
  std::vector<std::string> channels;
  std::vector<std::pair<std::string, std::string>> metadata;
};

/// Reads the header alone. Throws like read_exr, but for damage to what follows the header.
[[nodiscard]] ExrHeader read_exr_header(const std::filesystem::path& path);

/// Channels whose names begin so hold words of 32 bits under the guise of floats: they are integers
/// in an EXR, written and read with every bit.
inline constexpr std::string_view word_prefix = "state.";

/// Writes 32-bit channels, with the image's metadata as text attributes.
void write_exr(const std::filesystem::path& path, const Image& image,
               ExrCompression compression = ExrCompression::zip);

/// Writes the channels R, G and B as 8-bit sRGB. exposure: stops, a factor of 2^exposure before
/// encoding.
void write_png(const std::filesystem::path& path, const Image& image, float exposure);

/// Largest image that is read: pixels a side, pixels in all, and values in all channels.
inline constexpr long long largest_file_side = 1LL << 20;
inline constexpr long long largest_file_area = 1LL << 28;
inline constexpr long long largest_file_values = 1LL << 31;

/// Throws InputError for a size that a file announces beyond these limits, or beyond what its bytes
/// can hold: a value of a channel for each, times values_per_byte.
void check_file_image_size(const std::filesystem::path& path, long long width, long long height,
                           std::size_t channels,
                           double values_per_byte = std::numeric_limits<double>::infinity());

/// Bytes that one byte of a deflated stream stands for at most (https://zlib.net/zlib_tech.html).
inline constexpr double largest_inflation = 1032;

/// Throws InputError unless a file can be written at path; leaves nothing behind and changes
/// nothing.
void check_writable(const std::filesystem::path& path);

}  // namespace facet
