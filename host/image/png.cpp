#include <png.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <new>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/memory.h"
#include "image/coded_reader.h"
#include "image/files.h"

namespace facet {

namespace {

/// IEC 61966-2-1, 8 bits. NaN becomes black.
std::uint8_t encode_srgb(float linear) {
  const double x = linear > 0 ? std::min(static_cast<double>(linear), 1.0) : 0.0;
  const double v = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(v * 255));
}

/// libpng's image of a file, released at the end.
struct PngFile : png_image {
  PngFile() : png_image{} { version = PNG_IMAGE_VERSION; }
  ~PngFile() { png_image_free(this); }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;
};

/// The samples of a PNG as they are: libpng's simplified reader would apply gamma and lay what is
/// transparent over a background.
class PngReader {
 public:
  PngReader()
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &PngReader::on_error,
                                    &PngReader::on_warning)) {
    if (png_ == nullptr) throw std::bad_alloc();
    info_ = png_create_info_struct(png_);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  // libpng leaves these by longjmp on an error: nothing that has a destructor may live in them.
  [[nodiscard]] bool read_header(std::FILE* in) {
    if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) return false;
    png_init_io(png_, in);
    png_read_info(png_, info_);
    png_set_expand(png_);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
    png_set_strip_alpha(png_);
    png_set_gray_to_rgb(png_);
    (void)png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }
  /// Of all rows, three samples of sample_size() bytes a pixel.
  [[nodiscard]] bool read_pixels(std::vector<std::uint8_t>& pixels) {
    const std::size_t row_bytes = 3 * sample_size() * static_cast<std::size_t>(width());
    if (png_get_rowbytes(png_, info_) != row_bytes) {
      message_ = "its samples cannot be made R, G and B";
      return false;
    }
    rows_.clear();
    for (std::size_t y = 0; y < height(); ++y) rows_.push_back(pixels.data() + y * row_bytes);
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, rows_.data());
    png_read_end(png_, nullptr);
    return true;
  }
  [[nodiscard]] std::size_t sample_size() const {
    return png_get_bit_depth(png_, info_) == 16 ? 2 : 1;
  }
  [[nodiscard]] png_uint_32 width() const { return png_get_image_width(png_, info_); }
  [[nodiscard]] png_uint_32 height() const { return png_get_image_height(png_, info_); }
  /// Grey of one bit is three values a pixel.
  [[nodiscard]] static double values_per_byte() { return 3 * 8 * largest_inflation; }
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
    static_cast<PngReader*>(png_get_error_ptr(png))->message_ = message;
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp /*png*/, png_const_charp /*message*/) {}

  png_structp png_;
  png_infop info_ = nullptr;
  std::vector<png_bytep> rows_;
  std::string message_;
};

std::vector<std::uint8_t> encode_pixels(const Image& image, float exposure) {
  const float factor = std::exp2(exposure);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3 * static_cast<std::size_t>(image.width()) *
                 static_cast<std::size_t>(image.height()));
  const int channels[3] = {image.find_channel("R"), image.find_channel("G"),
                           image.find_channel("B")};
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (const int c : channels) pixels.push_back(encode_srgb(image.at(x, y, c) * factor));
    }
  }
  return pixels;
}

}  // namespace

CodedImage read_png(const std::filesystem::path& path) {
  return read_coded<PngReader>(path, "PNG");
}

void write_png(const std::filesystem::path& path, const Image& image, float exposure) {
  const Activity activity("writing " + path.string());
  const std::vector<std::uint8_t> pixels = encode_pixels(image, exposure);
  AtomicFile file(path);
  std::FILE* out = ::fdopen(::dup(file.descriptor()), "wb");
  if (out == nullptr)
    throw InputError(fmt::format("{}: cannot write: {}", path.string(), std::strerror(errno)));
  PngFile png;
  png.width = static_cast<png_uint_32>(image.width());
  png.height = static_cast<png_uint_32>(image.height());
  png.format = PNG_FORMAT_RGB;
  errno = 0;
  const bool written = png_image_write_to_stdio(&png, out, 0, pixels.data(), 0, nullptr) != 0;
  int error = errno;
  const bool closed = std::fclose(out) == 0;
  if (written && !closed) error = errno;
  if (!written || !closed)
    throw InputError(fmt::format("{}: cannot write: {}", path.string(),
                                 error != 0 ? std::strerror(error) : png.message));
  file.commit();
}

}  // namespace facet
