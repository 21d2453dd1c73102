#include "scene/mesh/obj_parser.h"

#include <array>
#include <charconv>
#include <cmath>
#include <exception>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"

namespace facet {

namespace {

/// Bytes that are parsed as one task, about.
constexpr std::size_t portion_size = 1U << 20U;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Takes the next word off the line; empty at its end or at a comment.
std::string_view next_word(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && is_blank(line[begin])) ++begin;
  std::size_t end = begin;
  while (end < line.size() && !is_blank(line[end])) ++end;
  const std::string_view word = line.substr(begin, end - begin);
  if (word.starts_with('#')) return {};
  line.remove_prefix(end);
  return word;
}

/// Calls body(keyword, rest) for every line that has a word; `line` counts those that are done.
template <typename Body>
void for_each_line(std::string_view text, long long& line, const Body& body) {
  for (; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view rest = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string_view keyword = next_word(rest);
    if (!keyword.empty()) body(keyword, rest);
  }
}

/// What precedes a place in the file.
struct Counts {
  long long lines = 0;
  long long positions = 0;
  long long texcoords = 0;
  long long normals = 0;
};

Counts operator+(const Counts& a, const Counts& b) {
  return {a.lines + b.lines, a.positions + b.positions, a.texcoords + b.texcoords, a.normals + b.normals};
}

Counts count(std::string_view text) {
  Counts c;
  for_each_line(text, c.lines, [&](std::string_view keyword, std::string_view /*rest*/) {
    if (keyword == "v") ++c.positions;
    if (keyword == "vt") ++c.texcoords;
    if (keyword == "vn") ++c.normals;
  });
  return c;
}

/// Whole lines each.
std::vector<std::string_view> split_in_portions(std::string_view text) {
  std::vector<std::string_view> portions;
  while (!text.empty()) {
    const std::size_t newline = text.find('\n', std::min(portion_size, text.size()) - 1);
    const std::size_t size = newline == std::string_view::npos ? text.size() : newline + 1;
    portions.push_back(text.substr(0, size));
    text.remove_prefix(size);
  }
  return portions;
}

/// Parses one portion, knowing what precedes it and what the whole file holds.
class PortionParser {
 public:
  PortionParser(const std::filesystem::path& path, const Counts& before, const Counts& total, ObjText& result,
                ObjFaces& faces)
      : path_(path), at_(before), total_(total), result_(result), faces_(faces) {}

  void parse(std::string_view text) {
    for_each_line(text, at_.lines, [this](std::string_view keyword, std::string_view rest) {
      if (keyword == "v") result_.positions[index(at_.positions++)] = vec3(read_vector(rest, 3));
      if (keyword == "vt") result_.texcoords[index(at_.texcoords++)] = vec2(read_vector(rest, 1));
      if (keyword == "vn") result_.normals[index(at_.normals++)] = vec3(read_vector(rest, 3));
      if (keyword == "f") read_face(rest);
    });
  }

 private:
  static std::size_t index(long long i) { return static_cast<std::size_t>(i); }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError({path_.string(), static_cast<int>(at_.lines + 1)}, message);
  }

  /// The first three coordinates; 0 for those that may miss and do.
  [[nodiscard]] vec3 read_vector(std::string_view rest, int least) const {
    vec3 v(0);
    int count = 0;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++count) {
      if (word == "\\") fail("lines continued by a backslash are not supported");
      const auto value = parse_real(word);
      if (!value || std::abs(*value) > std::numeric_limits<float>::max())
        fail(fmt::format("\"{}\" is not a finite number", word));
      if (count < 3) v[count] = static_cast<float>(*value);
    }
    if (count < least) fail(fmt::format("a vertex of {} coordinates; at least {} expected", count, least));
    return v;
  }

  void read_face(std::string_view rest) {
    std::uint32_t corners = 0;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++corners) {
      if (word == "\\") fail("lines continued by a backslash are not supported");
      faces_.corners.push_back(read_corner(word));
    }
    if (corners < 3) fail(fmt::format("a face of {} corners; at least 3 expected", corners));
    faces_.sizes.push_back(corners);
  }

  /// "7", "7/2", "7//5", "7/2/5".
  [[nodiscard]] ObjCorner read_corner(std::string_view word) const {
    ObjCorner corner;
    const char* at = word.data();
    const char* const end = at + word.size();
    corner.position = read_index(word, at, at_.positions, total_.positions, "vertices");
    if (at != end && *at == '/') {
      ++at;
      if (at != end && *at != '/')
        corner.texcoord = read_index(word, at, at_.texcoords, total_.texcoords, "texture coordinates");
      if (at != end && *at == '/') {
        ++at;
        if (at != end) corner.normal = read_index(word, at, at_.normals, total_.normals, "normals");
      }
    }
    if (at != end) fail_corner(word);
    return corner;
  }

  [[noreturn]] void fail_corner(std::string_view word) const {
    fail(fmt::format("\"{}\" is not the corner of a face", word));
  }

  /// From 1 in the file, or negative and counted from the last before it; moves `at` behind it.
  std::uint32_t read_index(std::string_view word, const char*& at, long long before, long long total,
                           const char* what) const {
    long long i = 0;
    const char* const end = word.data() + word.size();
    if (end - at > 1 && at[0] == '+' && at[1] != '-') ++at;
    const auto [behind, error] = std::from_chars(at, end, i);
    if (error != std::errc{}) fail_corner(word);
    at = behind;
    if (i > 0 && i <= total) return static_cast<std::uint32_t>(i - 1);
    if (i < 0 && i >= -before) return static_cast<std::uint32_t>(before + i);
    fail(fmt::format("index {} is out of range: there are {} {}", i, i < 0 ? before : total, what));
  }

  const std::filesystem::path& path_;
  Counts at_;
  Counts total_;
  ObjText& result_;
  ObjFaces& faces_;
};

}  // namespace

ObjText parse_obj(const std::filesystem::path& path, std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  const std::vector<std::string_view> portions = split_in_portions(text);
  std::vector<Counts> before(portions.size());
  parallel_for(portions.size(), 1,
               [&](std::size_t i, std::size_t /*end*/) { before[i] = count(portions[i]); });
  Counts total;
  for (Counts& c : before) total = total + std::exchange(c, total);

  ObjText result;
  result.positions.resize(static_cast<std::size_t>(total.positions));
  result.texcoords.resize(static_cast<std::size_t>(total.texcoords));
  result.normals.resize(static_cast<std::size_t>(total.normals));
  result.faces.resize(portions.size());
  std::vector<std::exception_ptr> failures(portions.size());
  parallel_for(portions.size(), 1, [&](std::size_t i, std::size_t /*end*/) {
    try {
      PortionParser(path, before[i], total, result, result.faces[i]).parse(portions[i]);
    } catch (const InputError&) {
      failures[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  return result;
}

}  // namespace facet
