#include "core/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <random>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace facet {

namespace {

constexpr const char* prefix = ".facet-";
constexpr const char* suffix = ".part";

/// Path of the present temporary file, for a signal handler.
std::atomic<const char*> unfinished{nullptr};

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

/// Removes temporary files that no running program can still be writing.
void sweep(const std::filesystem::path& folder) {
  std::error_code error;
  const auto now = std::filesystem::file_time_type::clock::now();
  for (auto entry = std::filesystem::directory_iterator(folder, error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(suffix)) continue;
    std::error_code ignored;
    const auto written = std::filesystem::last_write_time(entry->path(), ignored);
    if (!ignored && now - written > std::chrono::hours(1))
      std::filesystem::remove(entry->path(), ignored);
  }
}

int open_retrying(const std::filesystem::path& path, int flags) {
  int descriptor = -1;
  do descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  while (descriptor < 0 && errno == EINTR);
  return descriptor;
}

/// Has `make` make something under names in the folder that cannot be guessed, until one is free.
/// Returns what it returns, -1 with errno for a failure.
template <typename Make>
int make_named(const std::filesystem::path& folder, std::filesystem::path& path, const Make& make) {
  std::random_device random;
  for (int attempt = 0; attempt < 100; ++attempt) {
    path = folder / fmt::format("{}{:08x}{:08x}{}", prefix, random(), random(), suffix);
    const int made = make(path);
    if (made >= 0 || errno != EEXIST) return made;
  }
  return -1;
}

/// By which a file without a name can be given one.
std::string path_of(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }

/// A new file of that folder without a name; -1 where there is no such thing.
int open_unnamed(const std::filesystem::path& folder) {
  const int descriptor = open_retrying(folder, O_WRONLY | O_TMPFILE);
  if (descriptor >= 0 && ::access(path_of(descriptor).c_str(), F_OK) != 0) {
    ::close(descriptor);
    return -1;
  }
  return descriptor;
}

/// A new file in the folder; -1 with errno.
int open_new(const std::filesystem::path& folder, std::filesystem::path& path) {
  return make_named(folder, path, [](const std::filesystem::path& name) {
    return open_retrying(name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW);
  });
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path target) : target_(std::move(target)) {
  // What a link points to is replaced, not the link.
  std::error_code unknown;
  if (std::filesystem::is_symlink(target_, unknown)) {
    const auto resolved = std::filesystem::weakly_canonical(target_, unknown);
    if (!unknown) target_ = resolved;
  }
  if (std::filesystem::is_directory(target_, unknown))
    throw InputError(fmt::format("{}: cannot write: is a folder", target_.string()));
  // Devices and pipes are written to, not replaced.
  in_place_ = std::filesystem::is_other(target_, unknown);
  if (in_place_) return;
  if (target_.filename().string().size() > 255)
    throw InputError(
        fmt::format("{}: cannot write: a file's name has 255 bytes at most", target_.string()));
  descriptor_ = open_unnamed(folder_of(target_));
  if (descriptor_ >= 0) return;
  descriptor_ = open_new(folder_of(target_), temporary_);
  if (descriptor_ < 0) {
    const int error = errno;
    const bool missing = error == ENOENT || error == ENOTDIR;
    const char* why = missing           ? "no such folder"
                      : error == EACCES ? "no permission"
                                        : std::strerror(error);
    throw InputError(fmt::format("{}: cannot write: {}", target_.string(), why));
  }
  unfinished = temporary_.c_str();
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (in_place_ || temporary_.empty()) return;
  unfinished = nullptr;
  ::unlink(temporary_.c_str());
}

void AtomicFile::remove_unfinished() noexcept {
  const char* path = unfinished;
  if (path != nullptr) ::unlink(path);
}

void AtomicFile::fail(int error) {
  if (error_ == 0) error_ = error;
  throw InputError(fmt::format("{}: cannot write: {}", target_.string(), std::strerror(error_)));
}

int AtomicFile::descriptor() {
  if (descriptor_ < 0) descriptor_ = open_retrying(target_, O_WRONLY);
  if (descriptor_ < 0) fail(errno);
  return descriptor_;
}

void AtomicFile::write(const void* data, std::size_t size) {
  check();
  const auto* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::write(descriptor(), bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(written < 0 ? errno : EIO);
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

std::uint64_t AtomicFile::position() {
  const off_t at = ::lseek(descriptor(), 0, SEEK_CUR);
  if (at < 0) fail(errno);
  return static_cast<std::uint64_t>(at);
}

void AtomicFile::seek(std::uint64_t position) {
  if (::lseek(descriptor(), static_cast<off_t>(position), SEEK_SET) < 0) fail(errno);
}

bool AtomicFile::take_free_name() const {
  return temporary_.empty() && ::linkat(AT_FDCWD, path_of(descriptor_).c_str(), AT_FDCWD,
                                        target_.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

void AtomicFile::name_temporary() {
  if (!temporary_.empty()) return;
  const std::string source = path_of(descriptor_);
  std::filesystem::path path;
  const int made = make_named(folder_of(target_), path, [&](const std::filesystem::path& name) {
    return ::linkat(AT_FDCWD, source.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
  });
  if (made < 0) fail(errno);
  temporary_ = std::move(path);
  unfinished = temporary_.c_str();
}

void AtomicFile::commit() {
  check();
  // What cannot be synced, as a pipe, says EINVAL.
  if (descriptor_ >= 0 && ::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
    fail(errno);
  const bool is_placed = in_place_ || take_free_name();
  if (!is_placed) name_temporary();
  if (descriptor_ >= 0 && ::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
  if (in_place_) return;
  if (!is_placed && ::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  unfinished = nullptr;
  temporary_.clear();
  // The new name is lost in a crash until the folder is on the disk; not every file system lets a
  // folder be synced.
  const std::filesystem::path folder = folder_of(target_);
  const int opened = open_retrying(folder, O_RDONLY | O_DIRECTORY);
  if (opened >= 0) {
    (void)::fsync(opened);
    ::close(opened);
  }
  sweep(folder);
}

}  // namespace facet
