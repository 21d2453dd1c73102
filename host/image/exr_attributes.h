#pragma once
// The attributes of an EXR's header, as far as they can be looked at without OpenEXR.
#include <filesystem>
#include <string_view>

namespace facet {

/// With which an EXR begins.
inline constexpr std::string_view exr_magic = "\x76\x2F\x31\x01";

/// Throws InputError where an attribute announces more bytes than the file has left, or others than
/// a value of its type has: OpenEXR would allocate them first, or take some for another attribute.
/// What is no EXR, and whatever else is wrong with one, is left to OpenEXR.
void check_exr_attributes(const std::filesystem::path& path);

}  // namespace facet
