#pragma once
// A check of OBJ text before it is parsed: tinyobjloader reads what is no number as 0 and drops faces that it
// cannot make sense of.
#include <filesystem>
#include <string_view>

namespace facet {

/// Throws InputError with the line of the first coordinate that is no finite number, vertex with too few of
/// them, or face with fewer than three corners or an index that is malformed, zero or out of range. A face
/// may name vertices that come later.
void check_obj(const std::filesystem::path& path, std::string_view text);

}  // namespace facet
