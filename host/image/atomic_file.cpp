#include "image/atomic_file.h"

#include <unistd.h>

#include <fstream>
#include <system_error>

#include "core/error.h"
#include "image/files.h"

namespace facet {

AtomicFile::AtomicFile(std::filesystem::path target) : target_(std::move(target)) {
  // What a link points to is replaced, not the link.
  std::error_code dangling;
  if (std::filesystem::is_symlink(target_)) {
    const auto resolved = std::filesystem::weakly_canonical(target_, dangling);
    if (!dangling) target_ = resolved;
  }
  temporary_ = target_;
  temporary_ += fmt::format(".{}.part", ::getpid());
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  std::error_code error;
  std::filesystem::rename(temporary_, target_, error);
  if (error) throw InputError(fmt::format("{}: cannot write: {}", target_.string(), error.message()));
}

void check_writable(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path))
    throw InputError(fmt::format("{}: cannot write: is a folder", path.string()));
  const AtomicFile file(path);
  if (!std::ofstream(file.temporary())) {
    const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    const char* why = std::filesystem::is_directory(folder) ? "no permission" : "no such folder";
    throw InputError(fmt::format("{}: cannot write: {}", path.string(), why));
  }
}

}  // namespace facet
