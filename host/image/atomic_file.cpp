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

}  // namespace facet
