#include "scene/mesh/obj_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/text.h"

namespace facet {

namespace {

constexpr std::string_view blanks = " \t\r";

/// Takes the next word off the line; empty at its end or at a comment.
std::string_view next_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, std::min(line.find_first_of(blanks), line.size()));
  if (word.starts_with('#')) return {};
  line.remove_prefix(word.size());
  return word;
}

class ObjCheck {
 public:
  ObjCheck(const std::filesystem::path& path, std::string_view text) : path_(path), text_(text) {}

  void run() {
    for_each_line([this](std::string_view keyword, std::string_view rest) {
      if (keyword == "v") check_coordinates(rest, 3, 0);
      if (keyword == "vt") check_coordinates(rest, 1, 1);
      if (keyword == "vn") check_coordinates(rest, 3, 2);
    });
    totals_ = counts_;
    counts_ = {};
    for_each_line([this](std::string_view keyword, std::string_view rest) {
      if (keyword == "v") ++counts_[0];
      if (keyword == "vt") ++counts_[1];
      if (keyword == "vn") ++counts_[2];
      if (keyword == "f") check_face(rest);
    });
  }

 private:
  template <typename Body>
  void for_each_line(const Body& body) {
    std::string_view rest = text_;
    for (line_ = 1; !rest.empty(); ++line_) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      std::string_view line = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      const std::string_view keyword = next_word(line);
      if (!keyword.empty() && (keyword[0] == 'v' || keyword[0] == 'f')) body(keyword, line);
    }
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError({path_.string(), line_}, message);
  }

  void check_coordinates(std::string_view rest, int least, std::size_t kind) {
    int count = 0;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++count) {
      if (word == "\\") fail("lines continued by a backslash are not supported");
      const auto value = parse_real(word);
      if (!value || std::abs(*value) > std::numeric_limits<float>::max())
        fail(fmt::format("\"{}\" is not a finite number", word));
    }
    if (count < least) fail(fmt::format("a vertex of {} coordinates; at least {} expected", count, least));
    ++counts_[kind];
  }

  void check_face(std::string_view rest) const {
    int corners = 0;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++corners) {
      if (word == "\\") fail("lines continued by a backslash are not supported");
      check_corner(word);
    }
    if (corners < 3) fail(fmt::format("a face of {} corners; at least 3 expected", corners));
  }

  /// "7", "7/2", "7//5", "7/2/5", each index from 1, or negative and counted from the last.
  void check_corner(std::string_view corner) const {
    std::string_view rest = corner;
    for (std::size_t kind = 0; kind < 3; ++kind) {
      const std::size_t end = std::min(rest.find('/'), rest.size());
      const std::string_view digits = rest.substr(0, end);
      if (!digits.empty() || kind == 0) check_index(corner, digits, kind);
      if (end == rest.size()) return;
      rest.remove_prefix(end + 1);
    }
    fail(fmt::format("\"{}\" is not the corner of a face", corner));
  }

  void check_index(std::string_view corner, std::string_view digits, std::size_t kind) const {
    constexpr std::array<const char*, 3> names{"vertices", "texture coordinates", "normals"};
    const auto index = parse_integer(digits);
    if (!index) fail(fmt::format("\"{}\" is not the corner of a face", corner));
    const bool in_range = *index > 0 ? *index <= totals_[kind] : (*index < 0 && -*index <= counts_[kind]);
    if (in_range) return;
    fail(fmt::format("index {} is out of range: there are {} {}", *index,
                     *index < 0 ? counts_[kind] : totals_[kind], names[kind]));
  }

  const std::filesystem::path& path_;
  std::string_view text_;
  int line_ = 0;
  std::array<long long, 3> counts_{};  ///< of vertices, texture coordinates and normals so far
  std::array<long long, 3> totals_{};
};

}  // namespace

void check_obj(const std::filesystem::path& path, std::string_view text) { ObjCheck(path, text).run(); }

}  // namespace facet
