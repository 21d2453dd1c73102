#include "image/atomic_file.h"

#include <unistd.h>

#include <system_error>

#include "core/error.h"

namespace facet {

AtomicFile::AtomicFile(std::filesystem::path target) : target_(std::move(target)) {
  // What a link points to is replaced, not the link.
  std::error_code dangling;
  if (std::filesystem::is_symlink(target_)) {
    const auto resolved = std::filesystem::weakly_canonical(target_, dangling);
    if (!dangling) target_ = resolved;
  }
  temporary_ = target_;
  // Devices and pipes are written to, not replaced.
  std::error_code unknown;
  in_place_ = std::filesystem::is_other(target_, unknown);
  if (in_place_) return;
  temporary_ += fmt::format(".{}.part", ::getpid());
}

AtomicFile::~AtomicFile() {
  if (in_place_) return;
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  if (in_place_) return;
  std::error_code error;
  std::filesystem::rename(temporary_, target_, error);
  if (error) throw InputError(fmt::format("{}: cannot write: {}", target_.string(), error.message()));
}

}  // namespace facet
