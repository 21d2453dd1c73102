#include <csetjmp>
#include <cstdio>

// libjpeg's headers expect what the standard's declare.
#include <jerror.h>
#include <jpeglib.h>

#include "image/coded_reader.h"

namespace facet {

namespace {

/// A JPEG's samples. libjpeg leaves by longjmp on an error: nothing that has a destructor may live
/// in the functions that call it.
class JpegReader {
 public:
  JpegReader() : info_{}, handlers_{} {
    info_.err = jpeg_std_error(&handlers_);
    info_.client_data = this;
    handlers_.error_exit = &JpegReader::on_error;
    handlers_.emit_message = &JpegReader::on_warning;
    handlers_.output_message = [](j_common_ptr /*info*/) {};
  }
  ~JpegReader() { jpeg_destroy_decompress(&info_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  [[nodiscard]] bool read_header(std::FILE* in) {
    if (setjmp(on_failure_) != 0) return false;
    jpeg_create_decompress(&info_);
    jpeg_stdio_src(&info_, in);
    (void)jpeg_read_header(&info_, TRUE);
    info_.out_color_space = JCS_RGB;
    return true;
  }
  /// Of all rows, three bytes a pixel.
  [[nodiscard]] bool read_pixels(std::vector<std::uint8_t>& pixels) {
    if (setjmp(on_failure_) != 0) return false;
    (void)jpeg_start_decompress(&info_);
    while (info_.output_scanline < info_.output_height) {
      JSAMPROW row = pixels.data() + 3 * std::size_t{info_.output_width} * info_.output_scanline;
      (void)jpeg_read_scanlines(&info_, &row, 1);
    }
    (void)jpeg_finish_decompress(&info_);
    return true;
  }
  [[nodiscard]] static std::size_t sample_size() { return 1; }
  [[nodiscard]] unsigned width() const { return info_.image_width; }
  [[nodiscard]] unsigned height() const { return info_.image_height; }
  /// Arithmetic coding has no limit.
  [[nodiscard]] static double values_per_byte() { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] const char* message() const { return message_; }

 private:
  static JpegReader& reader_of(j_common_ptr info) {
    return *static_cast<JpegReader*>(info->client_data);
  }

  [[noreturn]] static void on_error(j_common_ptr info) {
    info->err->format_message(info, reader_of(info).message_);
    std::longjmp(reader_of(info).on_failure_, 1);
  }
  /// libjpeg would make up what is missing.
  static void on_warning(j_common_ptr info, int level) {
    if (level < 0 &&
        (info->err->msg_code == JWRN_JPEG_EOF || info->err->msg_code == JWRN_HIT_MARKER))
      on_error(info);
  }

  jpeg_decompress_struct info_;
  jpeg_error_mgr handlers_;
  std::jmp_buf on_failure_{};
  char message_[JMSG_LENGTH_MAX]{};
};

}  // namespace

CodedImage read_jpeg(const std::filesystem::path& path) {
  return read_coded<JpegReader>(path, "JPEG");
}

}  // namespace facet
