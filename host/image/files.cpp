#include "image/files.h"

#include <unistd.h>

#include "core/error.h"
#include "image/atomic_file.h"

namespace facet {

namespace {

constexpr long long largest_side = 1 << 20;
constexpr long long largest_area = 1LL << 30;

}  // namespace

Image read_image(const std::filesystem::path& path) {
  const std::filesystem::path extension = path.extension();
  if (extension == ".exr") return read_exr(path);
  if (extension == ".png") return read_png(path);
  throw InputError(
      fmt::format("{}: the format follows the extension, which must be .exr or .png", path.string()));
}

void check_readable(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw InputError(fmt::format("{}: no such file", path.string()));
  if (!std::filesystem::is_regular_file(path)) throw InputError(fmt::format("{}: not a file", path.string()));
}

void check_file_image_size(const std::filesystem::path& path, long long width, long long height) {
  if (width < 1 || height < 1 || width > largest_side || height > largest_side ||
      width * height > largest_area)
    throw InputError(fmt::format("{}: unreasonable image size {}x{}", path.string(), width, height));
}

void check_writable(const std::filesystem::path& path) {
  const AtomicFile file(path);
  // Opening a pipe would wait for its reader.
  if (file.in_place() && ::access(path.c_str(), W_OK) != 0)
    throw InputError(fmt::format("{}: cannot write: no permission", path.string()));
}

}  // namespace facet
