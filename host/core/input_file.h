#pragma once
// Files that are read: whether there is one, what it holds, and what it is when it is not what was
// expected.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace facet {

/// Throws InputError unless there is a regular file at path. The message hints at what was meant: a
/// file whose name differs in case, or slashes in place of backslashes. Anything else than a file
/// is refused before it is opened: a pipe would block.
void check_input_file(const std::filesystem::path& path);

/// All bytes of a file. Throws InputError like check_input_file, or where it cannot be read.
[[nodiscard]] std::string read_input_file(const std::filesystem::path& path);

/// The first bytes of a file, at most 1000. Throws InputError like check_input_file, or where it
/// cannot be read.
[[nodiscard]] std::string read_start(const std::filesystem::path& path);

/// What a file is that is not of the wanted kind, and what to do about it, where its first bytes
/// tell: `it is a Git LFS pointer in place of the file; "git lfs pull" fetches it`. Nothing for
/// bytes that tell nothing. wanted: `a PNG image`.
[[nodiscard]] std::optional<std::string> recognise_foreign_file(std::string_view start,
                                                                std::string_view wanted);

/// The same for a file that is known not to be of the wanted kind: where its first bytes tell
/// nothing, they are quoted.
[[nodiscard]] std::string describe_foreign_file(std::string_view start, std::string_view wanted);

}  // namespace facet
