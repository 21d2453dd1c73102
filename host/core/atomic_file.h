#pragma once
// A file that appears under its name only when it is whole.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace facet {

/// Writes to a temporary file in the target's folder; commit() gives it the target's name once all
/// of it is on the disk, the destructor removes what was not committed. What stood under that name
/// stays as it was until then. Where the file system lets a file have no name, the temporary file
/// has none before commit(), and a killed program leaves none, unless it is killed between the two
/// calls that put the file in another's place. Elsewhere its name cannot be
/// guessed, no file or link of that name is followed, and those that a killed program left in the
/// folder an hour ago or earlier are removed by commit(). A target that is a device or a pipe is
/// written to directly, and stays.
class AtomicFile {
 public:
  /// Throws InputError where the folder is missing or takes no file.
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Whether the target is a device or a pipe.
  [[nodiscard]] bool in_place() const noexcept { return in_place_; }
  /// The open file. A pipe is opened here and not before, since that waits for its reader.
  [[nodiscard]] int descriptor();

  /// Writes at the present position. Throws InputError where not all of it could be written, and
  /// commit() will then throw again: writers that swallow exceptions, as destructors do, cannot
  /// commit a damaged file.
  void write(const void* data, std::size_t size);
  void write(const std::string& text) { write(text.data(), text.size()); }
  /// Throws InputError if anything written so far could not be.
  void check() {
    if (error_ != 0) fail(error_);
  }
  [[nodiscard]] std::uint64_t position();
  void seek(std::uint64_t position);

  /// Syncs file and folder. Throws InputError where the file cannot be completed or cannot take the
  /// target's name.
  void commit();

  /// Removes the temporary file of this process, if there is one just now. For signal handlers:
  /// async-signal-safe.
  static void remove_unfinished() noexcept;

 private:
  [[noreturn]] void fail(int error);
  /// Gives a file without a name that of the target, if nothing has that yet; says whether.
  [[nodiscard]] bool take_free_name() const;
  /// Gives the temporary file a name, if it has none.
  void name_temporary();

  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty while the file has no name
  bool in_place_ = false;
  int descriptor_ = -1;
  int error_ = 0;  ///< errno of the first failure
};

}  // namespace facet
