#pragma once
// A file that appears under its name only when it is whole.
#include <filesystem>

namespace facet {

/// Hands out a temporary path beside the target; commit() renames it, the destructor removes what was not
/// committed. A target that is a device or a pipe is its own temporary path, and stays.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  [[nodiscard]] const std::filesystem::path& temporary() const noexcept { return temporary_; }
  /// Whether the target is a device or a pipe.
  [[nodiscard]] bool in_place() const noexcept { return in_place_; }
  /// Throws InputError where the file cannot take the target's name.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  bool in_place_ = false;
};

}  // namespace facet
