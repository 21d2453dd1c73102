#include "cli/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <functional>

#include "cli/exit_code.h"
#include "core/text.h"

namespace facet::cli {

namespace {

/// What the exit codes mean; the manuals' only words that no option brings along.
struct ExitCodeManual {
  ExitCode code;
  const char* meaning;
};
constexpr ExitCodeManual exit_codes[] = {
    {ExitCode::done, "done"},
    {ExitCode::check_failed,
     "a comparison, a test or a check did not hold; of a render: rays were cut short"},
    {ExitCode::bad_input,
     "wrong usage, bad input (the message names file and line), or a file that cannot be written"},
    {ExitCode::device_failed, "no usable device, or the device failed"},
    {ExitCode::interrupted, "interrupted; the image so far, and the checkpoint, are written"}};

void visit_options(const CommandManual& command,
                   const std::function<void(const OptionManual&)>& visit) {
  for (const OptionGroup& group : command.groups) std::ranges::for_each(group.options, visit);
}

/// "a|b" or "INT".
std::string value_text(const OptionManual& option) {
  return option.words.empty() ? option.value : fmt::format("{}", fmt::join(option.words, "|"));
}

/// The default, unless the help tells it or it says nothing.
std::string default_text(const OptionManual& option) {
  return option.default_value.empty() || option.value.empty()
             ? ""
             : fmt::format(" Default: {}.", option.default_value);
}

std::string sentence(std::string text) {
  if (!text.ends_with('.')) text += '.';
  return text;
}

std::string help_of(const OptionManual& option) {
  std::string text = sentence(option.help);
  if (option.is_repeated && option.help.find("repeated") == std::string::npos)
    text += " May be repeated.";
  return text + default_text(option);
}

// --------------------------------------------------------------------------- markdown

/// Characters that markdown and its tables take for their own; words with dashes before them are
/// options and become code.
std::string cell(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins_option = text.compare(i, 2, "--") == 0 && (i == 0 || text[i - 1] == ' ');
    if (begins_option) {
      std::size_t end = i;
      while (end < text.size() &&
             (text[end] == '-' || std::isalnum(static_cast<unsigned char>(text[end])) != 0))
        ++end;
      result += '`' + text.substr(i, end - i) + '`';
      i = end - 1;
      continue;
    }
    if (text[i] == '|' || text[i] == '<' || text[i] == '*') result += '\\';
    result += text[i];
  }
  return result;
}

std::string markdown_row(const OptionManual& option) {
  std::string name = fmt::format("{}", fmt::join(option.names, ", "));
  if (!option.is_argument && !option.value.empty()) name += ' ' + value_text(option);
  std::string escaped;
  for (const char c : name) escaped += c == '|' ? "\\|" : std::string(1, c);
  return fmt::format("| `{}` | {} |\n", escaped, cell(help_of(option)));
}

// ---------------------------------------------------------------------------------- man

/// Text of a line: dashes as they are typed, and no macro at its beginning.
std::string roff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '-')
      result += "\\-";
    else if (c == '\\')
      result += "\\e";
    else
      result += c;
  }
  return result.starts_with('.') || result.starts_with('\'') ? "\\&" + result : result;
}

std::string man_option(const OptionManual& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) names.push_back("\\fB" + roff(name) + "\\fR");
  std::string head = fmt::format("{}", fmt::join(names, ", "));
  if (!option.is_argument && !option.value.empty())
    head += " \\fI" + roff(value_text(option)) + "\\fR";
  return ".TP\n" + head + "\n" + roff(help_of(option)) + "\n";
}

// --------------------------------------------------------------------------------- bash

std::string option_names(const CommandManual& command) {
  std::string names = "-h --help";
  visit_options(command, [&](const OptionManual& option) {
    if (!option.is_argument) names += ' ' + fmt::format("{}", fmt::join(option.names, " "));
  });
  return names;
}

/// Cases of the words that may follow an option.
std::string value_cases(const CommandManual& command) {
  std::string cases;
  visit_options(command, [&](const OptionManual& option) {
    if (option.is_argument || option.value.empty() || option.words.empty()) return;
    for (const std::string& name : option.names)
      cases += fmt::format("        {}.{}) words=\"{}\" ;;\n", command.name, name,
                           fmt::join(option.words, " "));
  });
  return cases;
}

}  // namespace

std::string usage_of(const CommandManual& command) {
  std::string usage = "facet " + command.name + " [OPTIONS]";
  visit_options(command, [&](const OptionManual& option) {
    if (!option.is_argument) return;
    const std::string name = option.names.front() + (option.is_repeated ? "..." : "");
    usage += option.is_required ? ' ' + name : " [" + name + ']';
  });
  return usage;
}

std::string markdown_manual(const ProgramManual& program) {
  std::string text =
      "# The command line\n\nThis page is made from the program's table of options by `ninja "
      "command_line_page`; `facet\nCOMMAND --help` prints the same, and an installed facet has it "
      "as `man facet`.\n\n";
  for (const CommandManual& command : program.commands)
    text += fmt::format("- [`facet {}`](#facet-{}): {}\n", command.name, command.name,
                        cell(command.help));
  text += "\n## Exit codes\n\n| code | meaning |\n|---|---|\n";
  for (const ExitCodeManual& exit : exit_codes)
    text += fmt::format("| {} | {} |\n", static_cast<int>(exit.code), exit.meaning);
  for (const CommandManual& command : program.commands) {
    text += fmt::format("\n## facet {}\n\n{}\n\n```text\n{}\n```\n", command.name,
                        cell(sentence(command.help)), usage_of(command));
    for (const OptionGroup& group : command.groups) {
      if (!group.heading.empty()) text += fmt::format("\n{}:\n", group.heading);
      text += "\n| option | meaning |\n|---|---|\n";
      for (const OptionManual& option : group.options) text += markdown_row(option);
    }
  }
  return text;
}

std::string man_page(const ProgramManual& program) {
  std::string text = fmt::format(
      ".TH FACET 1 \"\" \"facet {}\" \"User Commands\"\n.SH NAME\nfacet \\- {}\n.SH SYNOPSIS\n",
      program.version, roff(program.description));
  for (const CommandManual& command : program.commands)
    text += ".B " + roff(usage_of(command)) + "\n.br\n";
  text += ".SH COMMANDS\n";
  for (const CommandManual& command : program.commands) {
    text += fmt::format(".SS facet {}\n{}\n", roff(command.name), roff(sentence(command.help)));
    for (const OptionGroup& group : command.groups) {
      if (!group.heading.empty()) text += ".PP\n" + roff(group.heading) + ":\n";
      for (const OptionManual& option : group.options) text += man_option(option);
    }
  }
  text += ".SH EXIT STATUS\n";
  for (const ExitCodeManual& exit : exit_codes)
    text += fmt::format(".TP\n.B {}\n{}\n", static_cast<int>(exit.code), roff(exit.meaning));
  return text;
}

std::string bash_completion(const ProgramManual& program) {
  std::vector<std::string> names;
  std::string options;
  std::string values;
  for (const CommandManual& command : program.commands) {
    names.push_back(command.name);
    options += fmt::format("        {}) words=\"{}\" ;;\n", command.name, option_names(command));
    values += value_cases(command);
  }
  return fmt::format(
      R"(# Completion of facet's commands, options and words; made by `facet manual --form bash`.
_facet() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} words=""
  COMPREPLY=()
  # --option=word is three words to bash.
  local joined=""
  if [ "$current" = "=" ]; then current="" joined=yes
  elif [ "$previous" = "=" ]; then previous=${{COMP_WORDS[COMP_CWORD-2]}} joined=yes
  fi
  if [ "$COMP_CWORD" -eq 1 ]; then
    words="{} --help --version"
  else
    case ${{COMP_WORDS[1]}}.$previous in
{}    esac
    if [ -z "$words$joined" ]; then
      case $current in
        -*)
          case ${{COMP_WORDS[1]}} in
{}          esac
          ;;
      esac
    fi
  fi
  # Without words, bash completes files.
  [ -z "$words" ] || mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}}
complete -o bashdefault -o default -F _facet facet
)",
      fmt::join(names, " "), values, options);
}

}  // namespace facet::cli
