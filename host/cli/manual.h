#pragma once
// What the program's commands and options are, as data, and the manuals made of it.
#include <string>
#include <vector>

namespace facet::cli {

/// An option, or an argument without a name.
struct OptionManual {
  std::vector<std::string> names;  ///< "-o", "--output"; of an argument one without dashes
  std::string value;               ///< what stands for its value: "INT", "TEXT"; empty: a flag
  std::vector<std::string> words;  ///< the values that it may have, if these are all
  std::string default_value;       ///< empty: none
  std::string help;
  bool is_argument = false;
  bool is_required = false;
  bool is_repeated = false;  ///< may be given more than once, or hold several
};

struct OptionGroup {
  std::string heading;  ///< empty: the command's options without one
  std::vector<OptionManual> options;
};

struct CommandManual {
  std::string name;
  std::string help;
  std::vector<OptionGroup> groups;  ///< none is empty
};

struct ProgramManual {
  std::string description;
  std::string version;
  std::vector<CommandManual> commands;
};

/// "facet compare [OPTIONS] image reference"
[[nodiscard]] std::string usage_of(const CommandManual& command);

/// A page of docs/guide.
[[nodiscard]] std::string markdown_manual(const ProgramManual& program);

/// A page for man(1), in the macros of groff_man(7).
[[nodiscard]] std::string man_page(const ProgramManual& program);

/// What bash sources to complete commands, options and their words.
[[nodiscard]] std::string bash_completion(const ProgramManual& program);

}  // namespace facet::cli
