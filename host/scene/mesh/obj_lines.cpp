#include "scene/mesh/obj_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/text.h"

namespace facet {

namespace {

constexpr std::string_view blanks = " \t";

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view without_blanks_before(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(blanks), text.size()));
}

std::string_view without_blanks_behind(std::string_view text) {
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Takes the next word off the line; empty at its end.
std::string_view next_word(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && is_blank(line[begin])) ++begin;
  std::size_t end = begin;
  while (end < line.size() && !is_blank(line[end])) ++end;
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

/// Moves `at` behind the digits; returns whether there are any.
bool skip_digits(std::string_view word, std::size_t& at) {
  const std::size_t begin = at;
  while (at < word.size() && is_digit(word[at])) ++at;
  return at > begin;
}

/// A number in decimals that a float can hold.
bool is_number(std::string_view word) {
  std::size_t at = !word.empty() && (word[0] == '-' || word[0] == '+') ? 1 : 0;
  bool has_digits = skip_digits(word, at);
  if (at < word.size() && word[at] == '.') has_digits = skip_digits(word, ++at) || has_digits;
  if (!has_digits) return false;
  bool may_be_large = word.size() > 30;
  if (at < word.size() && (word[at] == 'e' || word[at] == 'E')) {
    ++at;
    may_be_large = at < word.size() && word[at] != '-';
    if (at < word.size() && (word[at] == '-' || word[at] == '+')) ++at;
    if (!skip_digits(word, at)) return false;
  }
  if (at != word.size()) return false;
  if (!may_be_large) return true;
  const auto value = parse_real(word);
  return value && std::abs(*value) <= std::numeric_limits<float>::max();
}

}  // namespace

ObjLines::ObjLines(const std::filesystem::path& path, std::string text)
    : path_(path), text_(std::move(text)) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  newline_ = std::min(text_.find('\n', at_), text_.size());
  // Some editors of old end a text by Ctrl-Z, some programs by their strings' zero.
  constexpr std::string_view padding("\x1A\0 \t", 4);
  while (text_.size() > at_ && padding.find(text_.back()) != std::string_view::npos)
    text_.pop_back();
  newline_ = std::min(newline_, text_.size());
}

void ObjLines::fail(const std::string& message) const {
  throw InputError({path_.string(), line_}, message);
}

ObjLines::int_type ObjLines::underflow() {
  if (gptr() != egptr()) return traits_type::to_int_type(*gptr());
  while (at_ < text_.size()) {
    line_ = next_line_;
    if (!prepare(take_line())) continue;
    const char* const begin = handed_out_.data();
    // Nothing writes to the buffer: the loader reads, and never puts anything back.
    char* const first = const_cast<char*>(begin);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    setg(first, first, first + handed_out_.size());
    return traits_type::to_int_type(*first);
  }
  return traits_type::eof();
}

std::string_view ObjLines::take_line() {
  const std::size_t begin = at_;
  if (newline_ < begin) newline_ = std::min(text_.find('\n', begin), text_.size());
  const std::string_view line = std::string_view(text_).substr(begin, newline_ - begin);
  const std::size_t size = std::min(line.find('\r'), line.size());
  // A carriage return before a line feed is part of the line's end, any other one ends a line by
  // itself.
  at_ = begin + size + 1 < newline_ ? begin + size + 1 : newline_ + 1;
  ++next_line_;
  return line.substr(0, size);
}

bool ObjLines::prepare(std::string_view line) {
  const std::size_t end_of_line = at_;
  line = without_blanks_before(line);
  std::string_view words = line;
  std::string_view keyword = next_word(words);
  if (words.empty() && keyword.ends_with('\\')) keyword.remove_suffix(1);
  if (keyword == "usemtl" || keyword == "mtllib") {
    const std::string_view name = trimmed(words);
    if (keyword == "mtllib") {
      material_files_.emplace_back(name);
      return false;
    }
    handed_out_ = changed_ = fmt::format("usemtl {}\n", name);
    return true;
  }
  // The old name of a face is fo.
  const bool is_face = keyword == "f" || keyword == "fo";
  if (!is_face && keyword != "v" && keyword != "vt" && keyword != "vn") return false;
  const std::string_view statement = joined(line);
  words = statement;
  keyword = next_word(words);
  bool is_changed = keyword == "fo";
  if (is_face) {
    is_changed = check_face(words) || is_changed;
  } else if (keyword == "v") {
    check_vector(words, 3, 3, true);
  } else {
    check_vector(words, keyword == "vt" ? 2 : 3, keyword == "vt" ? 1 : 3, false);
  }
  const bool stands_in_text = statement.data() == line.data() && statement.size() == line.size() &&
                              end_of_line <= text_.size() && text_[end_of_line - 1] == '\n';
  if (stands_in_text && !is_changed) {
    handed_out_ = {line.data(), text_.data() + end_of_line};
    return true;
  }
  std::string copy = is_face ? "f" : std::string(keyword);
  for (std::string_view word = next_word(words); !word.empty(); word = next_word(words)) {
    // The loader would look for the index behind a last slash in the next corner.
    while (word.ends_with('/')) word.remove_suffix(1);
    copy.append(" ").append(word);
  }
  changed_ = copy + "\n";
  handed_out_ = changed_;
  return true;
}

std::string_view ObjLines::joined(std::string_view line) {
  std::string lines;
  bool is_continued = false;
  for (;;) {
    line = line.substr(0, line.find('#'));
    const std::string_view text = without_blanks_behind(line);
    const bool continues = text.ends_with('\\');
    if (!continues && !is_continued) return line;
    lines.append(continues ? text.substr(0, text.size() - 1) : line).append(" ");
    is_continued = true;
    if (!continues || at_ >= text_.size()) break;
    line = take_line();
  }
  joined_ = std::move(lines);
  return joined_;
}

void ObjLines::check_vector(std::string_view words, int used, int least, bool must_be_good) {
  flaw_.clear();
  int count = 0;
  for (std::string_view word = next_word(words); !word.empty(); word = next_word(words), ++count) {
    if (is_number(word)) continue;
    if (count >= used) {
      ++unused_bad_words_;
    } else if (flaw_.empty()) {
      flaw_ = fmt::format("\"{}\" is not a finite number", word);
    }
  }
  if (flaw_.empty() && count < least)
    flaw_ = fmt::format("a vertex of {} coordinates; at least {} expected", count, least);
  if (must_be_good && !flaw_.empty()) fail(flaw_);
}

bool ObjLines::check_face(std::string_view corners) const {
  bool has_slash_behind = false;
  int count = 0;
  for (std::string_view corner = next_word(corners); !corner.empty();
       corner = next_word(corners), ++count) {
    std::string_view rest = corner;
    for (int field = 0; field < 3; ++field) {
      const std::size_t slash = std::min(rest.find('/'), rest.size());
      // Texture coordinates and normals may miss.
      if (field == 0 || slash > 0) check_index(corner, rest.substr(0, slash));
      rest.remove_prefix(slash);
      if (rest.empty()) break;
      if (field == 2) fail(fmt::format("\"{}\" is not the corner of a face", corner));
      rest.remove_prefix(1);
    }
    has_slash_behind = has_slash_behind || corner.back() == '/';
  }
  if (count < 3) fail(fmt::format("a face of {} corners; at least 3 expected", count));
  return has_slash_behind;
}

void ObjLines::check_index(std::string_view corner, std::string_view index) const {
  std::size_t at = !index.empty() && (index[0] == '-' || index[0] == '+') ? 1 : 0;
  const std::size_t digits = at;
  if (!skip_digits(index, at) || at != index.size())
    fail(fmt::format("\"{}\" is not the corner of a face", corner));
  const std::size_t first = index.find_first_not_of('0', digits);
  // The loader reads nine digits at least, which are more than there can be vertices.
  if (first == std::string_view::npos || index.size() - first > 9)
    fail(fmt::format("index {} is out of range", index));
}

}  // namespace facet
