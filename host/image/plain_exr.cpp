#include "image/plain_exr.h"

#include <openexr.h>

#include <algorithm>
#include <new>
#include <string_view>

#include "image/files.h"

namespace facet {

namespace {

struct Unreadable {};

/// A file that is read through OpenEXRCore. Whatever cannot be read throws Unreadable.
class PlainExr {
 public:
  explicit PlainExr(const std::filesystem::path& path) {
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    // Errors are told by what the calls return.
    settings.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
    settings.flags = EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE;
    check(exr_start_read(&file_, path.c_str(), &settings));
  }
  ~PlainExr() {
    exr_decoding_destroy(file_, &pipeline_);
    exr_finish(&file_);
  }
  PlainExr(const PlainExr&) = delete;
  PlainExr& operator=(const PlainExr&) = delete;

  /// Whether the file is what this reader reads, and of the image's kind.
  [[nodiscard]] bool has_form_of(const Image& image) {
    int parts = 0;
    exr_storage_t storage{};
    exr_compression_t compression{};
    exr_attr_box2i_t window{};
    const exr_attr_chlist_t* channels = nullptr;
    check(exr_get_count(file_, &parts));
    check(exr_get_storage(file_, 0, &storage));
    check(exr_get_compression(file_, 0, &compression));
    check(exr_get_data_window(file_, 0, &window));
    check(exr_get_channels(file_, 0, &channels));
    first_row_ = window.min.y;
    return parts == 1 && storage == EXR_STORAGE_SCANLINE &&
           (compression == EXR_COMPRESSION_NONE || compression == EXR_COMPRESSION_ZIPS ||
            compression == EXR_COMPRESSION_ZIP) &&
           std::int64_t{window.max.x} - window.min.x + 1 == image.width() &&
           std::int64_t{window.max.y} - window.min.y + 1 == image.height() &&
           have_form_of(*channels, image);
  }

  void read(Image& image) {
    std::int32_t rows = 0;
    check(exr_get_scanlines_per_chunk(file_, 0, &rows));
    for (int y = 0; y < image.height(); y += rows) read_rows(image, y);
  }

 private:
  static bool have_form_of(const exr_attr_chlist_t& channels, const Image& image) {
    if (static_cast<std::size_t>(channels.num_channels) != image.channels().size()) return false;
    for (std::size_t i = 0; i < image.channels().size(); ++i) {
      const exr_attr_chlist_entry_t& channel = channels.entries[i];
      const std::string& name = image.channels()[i];
      const exr_pixel_type_t type =
          name.starts_with(word_prefix) ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT;
      if (name != channel.name.str || channel.pixel_type != type || channel.x_sampling != 1 ||
          channel.y_sampling != 1)
        return false;
    }
    return true;
  }

  /// The rows of the chunk that begins with row y of the image.
  void read_rows(Image& image, int y) {
    exr_chunk_info_t chunk{};
    check(exr_read_scanline_chunk_info(file_, 0, first_row_ + y, &chunk));
    const bool is_first = pipeline_.channels == nullptr;
    check(is_first ? exr_decoding_initialize(file_, 0, &chunk, &pipeline_)
                   : exr_decoding_update(file_, 0, &chunk, &pipeline_));
    for (std::int16_t i = 0; i < pipeline_.channel_count; ++i) {
      exr_coding_channel_info_t& channel = pipeline_.channels[i];
      float* row = &image.at(0, y, i);
      channel.decode_to_ptr = reinterpret_cast<std::uint8_t*>(row);  // NOLINT(*-reinterpret-cast)
      channel.user_pixel_stride = sizeof(float);
      channel.user_line_stride = static_cast<std::int32_t>(sizeof(float)) * image.width();
      channel.user_bytes_per_element = sizeof(float);
      channel.user_data_type = channel.data_type;
    }
    if (is_first) check(exr_decoding_choose_default_routines(file_, 0, &pipeline_));
    check(exr_decoding_run(file_, 0, &pipeline_));
  }

  static void check(exr_result_t result) {
    if (result == EXR_ERR_OUT_OF_MEMORY) throw std::bad_alloc();
    if (result != EXR_ERR_SUCCESS) throw Unreadable();
  }

  exr_context_t file_ = nullptr;
  exr_decode_pipeline_t pipeline_{};
  int first_row_ = 0;
};

}  // namespace

bool read_plain_exr(const std::filesystem::path& path, Image& image) {
  try {
    PlainExr file(path);
    if (!file.has_form_of(image)) return false;
    file.read(image);
    return true;
  } catch (const Unreadable&) {
    return false;
  }
}

}  // namespace facet
