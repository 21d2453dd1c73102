#include "scene/xml/encoding.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "core/text.h"

namespace facet {

namespace {

void append(std::string& text, std::uint32_t c) {
  const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (c > 0x10FFFF || (c >= 0xD800 && c < 0xE000)) c = 0xFFFD;
  if (c < 0x80) return add(c);
  if (c < 0x800) {
    add(0xC0U | c >> 6U);
  } else {
    if (c < 0x10000) {
      add(0xE0U | c >> 12U);
    } else {
      add(0xF0U | c >> 18U);
      add(0x80U | (c >> 12U & 0x3FU));
    }
    add(0x80U | (c >> 6U & 0x3FU));
  }
  add(0x80U | (c & 0x3FU));
}

/// Units of `size` bytes, the first one the most significant, or the last.
class Units {
 public:
  Units(std::string_view bytes, std::size_t size, bool big_endian)
      : bytes_(bytes), size_(size), big_endian_(big_endian) {}

  [[nodiscard]] bool empty() const { return bytes_.size() < size_; }
  [[nodiscard]] std::uint32_t front() const {
    std::uint32_t unit = 0;
    for (std::size_t i = 0; i < size_; ++i)
      unit = unit << 8U | static_cast<unsigned char>(bytes_[big_endian_ ? i : size_ - 1 - i]);
    return unit;
  }
  void drop() { bytes_.remove_prefix(size_); }

 private:
  std::string_view bytes_;
  std::size_t size_;
  bool big_endian_;
};

std::string from_units(Units units) {
  std::string text;
  for (; !units.empty(); units.drop()) {
    std::uint32_t c = units.front();
    if (c >= 0xD800 && c < 0xDC00) {
      Units next = units;
      next.drop();
      if (!next.empty() && next.front() >= 0xDC00 && next.front() < 0xE000) {
        c = 0x10000 + ((c - 0xD800) << 10U) + (next.front() - 0xDC00);
        units = next;
      }
    }
    if (c != 0xFEFF || !text.empty()) append(text, c);
  }
  return text;
}

bool declares_latin1(std::string_view bytes) {
  if (!bytes.starts_with("<?xml")) return false;
  const std::string declaration =
      lower_case(std::string(bytes.substr(0, std::min(bytes.find("?>"), bytes.size()))));
  return declaration.find("iso-8859-1") != std::string::npos ||
         declaration.find("latin1") != std::string::npos;
}

struct Sign {
  std::string_view start;
  std::size_t unit;
  bool big_endian;
};

}  // namespace

std::string to_utf8(std::string bytes) {
  using std::string_view_literals::operator""sv;
  // UTF-32 first: its little-endian mark begins with that of UTF-16.
  constexpr std::array<Sign, 8> signs{{{"\0\0\xFE\xFF"sv, 4, true},
                                       {"\xFF\xFE\0\0"sv, 4, false},
                                       {"\0\0\0<"sv, 4, true},
                                       {"<\0\0\0"sv, 4, false},
                                       {"\xFE\xFF"sv, 2, true},
                                       {"\xFF\xFE"sv, 2, false},
                                       {"\0<"sv, 2, true},
                                       {"<\0"sv, 2, false}}};
  for (const Sign& sign : signs) {
    if (std::string_view(bytes).starts_with(sign.start))
      return from_units(Units(bytes, sign.unit, sign.big_endian));
  }
  if (bytes.starts_with("\xEF\xBB\xBF")) return bytes.substr(3);
  if (declares_latin1(bytes)) return from_units(Units(bytes, 1, true));
  return bytes;
}

}  // namespace facet
