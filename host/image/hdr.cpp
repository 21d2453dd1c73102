#include <array>
#include <cmath>
#include <string_view>

#include "core/error.h"
#include "core/input_file.h"
#include "core/text.h"
#include "image/files.h"

namespace facet {

namespace {

/// Three mantissas and a common exponent. G. Ward, "Real Pixels", Graphics Gems II, 1991.
using Rgbe = std::array<std::uint8_t, 4>;

/// A picture of G. Ward's Radiance, as its manual "The Radiance Picture File Format" describes it.
class HdrReader {
 public:
  HdrReader(const std::filesystem::path& path, std::string_view bytes)
      : path_(path), rest_(bytes) {}

  [[nodiscard]] Image read() {
    const auto [width, height] = read_header();
    check_file_image_size(path_, width, height, 3);
    Image image(static_cast<int>(width), static_cast<int>(height), {"R", "G", "B"});
    std::vector<Rgbe> row(static_cast<std::size_t>(width));
    for (int y = 0; y < image.height(); ++y) {
      read_row(row);
      for (int x = 0; x < image.width(); ++x) {
        const Rgbe& pixel = row[static_cast<std::size_t>(x)];
        for (int c = 0; c < 3; ++c)
          image.at(x, y, c) =
              std::ldexp(static_cast<float>(pixel[static_cast<std::size_t>(c)]), pixel[3] - 136);
      }
    }
    return image;
  }

 private:
  [[noreturn]] void fail(std::string_view message) const {
    throw InputError(fmt::format("{}: not a readable HDR image: {}", path_.string(), message));
  }

  [[nodiscard]] std::string_view take_line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) fail("its header has no end");
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
  }

  /// Width and height.
  [[nodiscard]] std::pair<long long, long long> read_header() {
    for (std::string_view line = take_line(); !line.empty(); line = take_line()) {
      if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
        fail(fmt::format("{} is not supported, only 32-bit_rle_rgbe", line));
    }
    const std::string_view line = take_line();
    const std::vector<std::string_view> words = split_list(line);
    if (words.size() == 4 && words[0] == "-Y" && words[2] == "+X") {
      const auto height = parse_integer(words[1]);
      const auto width = parse_integer(words[3]);
      if (width && height) return {*width, *height};
    }
    fail(fmt::format("its size is \"{}\"; -Y height +X width expected", line));
  }

  std::uint8_t take_byte() {
    if (rest_.empty()) fail("it ends too early");
    const auto byte = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    return byte;
  }

  [[nodiscard]] bool begins_with_runs(std::size_t width) const {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(rest_[i]); };
    return rest_.size() >= 4 && width >= 8 && width <= 0x7fff && byte(0) == 2 && byte(1) == 2 &&
           std::size_t{byte(2)} * 256 + byte(3) == width;
  }

  void read_row(std::vector<Rgbe>& row) {
    if (!begins_with_runs(row.size())) return read_pixels(row);
    rest_.remove_prefix(4);
    for (std::size_t component = 0; component < 4; ++component) read_runs(row, component);
  }

  /// One component of a row after another, in runs of one byte and in copies.
  void read_runs(std::vector<Rgbe>& row, std::size_t component) {
    for (std::size_t x = 0; x < row.size();) {
      const std::uint8_t code = take_byte();
      const bool is_run = code > 128;
      const std::size_t count = is_run ? code - 128U : code;
      if (count == 0 || count > row.size() - x) fail("a run leaves its row");
      const std::uint8_t value = is_run ? take_byte() : std::uint8_t{0};
      for (std::size_t i = 0; i < count; ++i) row[x++][component] = is_run ? value : take_byte();
    }
  }

  /// Whole pixels; (1, 1, 1, n) repeats the one before n times, and a second such one 256 n times.
  void read_pixels(std::vector<Rgbe>& row) {
    unsigned shift = 0;
    for (std::size_t x = 0; x < row.size();) {
      Rgbe pixel{};
      for (std::uint8_t& byte : pixel) byte = take_byte();
      if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
        row[x++] = pixel;
        shift = 0;
        continue;
      }
      const std::size_t count = std::size_t{pixel[3]} << shift;
      if (x == 0 || shift > 16 || count > row.size() - x) fail("a run leaves its row");
      for (std::size_t i = 0; i < count; ++i, ++x) row[x] = row[x - 1];
      shift += 8;
    }
  }

  const std::filesystem::path& path_;
  std::string_view rest_;
};

}  // namespace

Image read_hdr(const std::filesystem::path& path) {
  const std::string bytes = read_input_file(path);
  return HdrReader(path, bytes).read();
}

}  // namespace facet
