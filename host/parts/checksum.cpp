#include "parts/checksum.h"

#include <zlib.h>

#include <algorithm>
#include <array>

#include "core/error.h"
#include "image/record.h"

namespace facet {

namespace {

constexpr std::array<std::string_view, 4> channel_prefixes{"sum.", "square.", "samples", "state."};

std::uint32_t crc_of(std::uint32_t crc, const void* bytes, std::size_t size) {
  return static_cast<std::uint32_t>(
      ::crc32_z(crc, static_cast<const Bytef*>(bytes), static_cast<z_size_t>(size)));
}

std::uint32_t crc_of(std::uint32_t crc, const std::string& text) {
  // With its end, so that two texts are not one.
  return crc_of(crc, text.c_str(), text.size() + 1);
}

}  // namespace

std::string checksum(const Image& image) {
  std::vector<std::string> channels;
  for (const std::string& name : image.channels()) {
    const auto begins = [&](std::string_view prefix) { return name.starts_with(prefix); };
    if (std::ranges::any_of(channel_prefixes, begins)) channels.push_back(name);
  }
  std::ranges::sort(channels);
  Metadata metadata;
  for (const auto& entry : image.metadata) {
    if (entry.first.starts_with("facet.") && entry.first != checksum_key) metadata.push_back(entry);
  }
  std::ranges::sort(metadata);
  const std::size_t pixels =
      static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  std::uint32_t crc = 0;
  for (const std::string& name : channels) {
    crc = crc_of(crc, name);
    crc = crc_of(crc, image.plane(image.find_channel(name)), pixels * sizeof(float));
  }
  for (const auto& [key, text] : metadata) crc = crc_of(crc_of(crc, key), text);
  return fmt::format("{:08x}", crc);
}

void add_checksum(Image& image) {
  std::erase_if(image.metadata, [](const auto& entry) { return entry.first == checksum_key; });
  image.metadata.emplace_back(checksum_key, checksum(image));
}

void check_checksum(const Image& image, const std::string& name) {
  const std::string* told = find_metadata(image.metadata, checksum_key);
  if (told == nullptr)
    throw InputError(fmt::format("{}: lacks the metadata {} of a part", name, checksum_key));
  const std::string own = checksum(image);
  if (*told != own)
    throw InputError(
        fmt::format("{}: damaged, or changed after it was rendered: its checksum is {}, but {} "
                    "stands in it",
                    name, own, *told));
}

}  // namespace facet
