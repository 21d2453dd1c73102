#pragma once
// The lines of a Wavefront OBJ file as its loader can read them.
#include <filesystem>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace facet {

/// Hands out the statements of an OBJ file that matter (v, vt, vn, f and usemtl), one a line:
/// without comments, joined where a backslash continues them, whatever ends the lines. Checks the
/// words of each, since the loader takes for 0 what is no number.
class ObjLines : public std::streambuf {
 public:
  /// path: for messages; it is referred to.
  ObjLines(const std::filesystem::path& path, std::string text);

  /// Of the statement that was handed out last, counted from 1.
  [[nodiscard]] int line() const { return line_; }
  /// What is wrong with the last vt or vn, which nothing may use; empty without.
  [[nodiscard]] const std::string& flaw() const { return flaw_; }
  /// How many words that nothing uses are no numbers: a vertex's colours, a third texture
  /// coordinate.
  [[nodiscard]] std::size_t unused_bad_words() const { return unused_bad_words_; }
  /// The names after mtllib, as they stand in the file.
  [[nodiscard]] const std::vector<std::string>& material_files() const { return material_files_; }

  /// Throws InputError at the last statement.
  [[noreturn]] void fail(const std::string& message) const;

 protected:
  /// Makes the next statement the buffer. Throws InputError for one that cannot be read.
  int_type underflow() override;

 private:
  /// Moves to the next line; returns it without its end.
  [[nodiscard]] std::string_view take_line();
  /// Whether the loader is to see the line; `handed_out_` is what it sees then.
  [[nodiscard]] bool prepare(std::string_view line);
  /// A line of numbers without its comment, and with the lines that continue it.
  [[nodiscard]] std::string_view joined(std::string_view line);
  void check_vector(std::string_view words, int used, int least, bool must_be_good);
  /// Returns whether a corner ends in slashes.
  [[nodiscard]] bool check_face(std::string_view corners) const;
  void check_index(std::string_view corner, std::string_view index) const;

  const std::filesystem::path& path_;
  std::string text_;
  std::size_t at_ = 0;       ///< where the next line begins
  std::size_t newline_ = 0;  ///< the first one from there on, or the text's end
  int line_ = 0;
  int next_line_ = 1;
  std::string joined_;
  std::string changed_;  ///< a statement that does not stand in the text as the loader can read it
  std::string_view handed_out_;
  std::string flaw_;
  std::size_t unused_bad_words_ = 0;
  std::vector<std::string> material_files_;
};

}  // namespace facet
