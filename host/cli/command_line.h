#pragma once
// Subcommands and their options. Behind it stands CLI11, which no other file includes: it takes ten
// seconds to compile.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/exit_code.h"
#include "cli/manual.h"
#include "core/words.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace facet::cli {

struct Limits;

/// One subcommand. Every option sets the variable that it is given, which must live until the
/// command has run; a variable that has a value shows it as the default.
class Command {
 public:
  /// chosen: set to what the command does where it is the one that was named.
  /// limits: those of every command.
  Command(CLI::App& app, std::function<ExitCode()>& chosen, Limits& limits)
      : app_(&app), chosen_(&chosen), limits_(&limits) {}

  // Arguments without a name, in order.
  void argument(const std::string& name, std::string& value, const std::string& help,
                bool required = true);
  void arguments(const std::string& name, std::vector<std::string>& values, const std::string& help,
                 bool required = true);

  void flag(const std::string& name, bool& value, const std::string& help);
  void text(const std::string& name, std::string& value, const std::string& help);
  void text(const std::string& name, std::optional<std::string>& value, const std::string& help);
  void path(const std::string& name, std::filesystem::path& value, const std::string& help);
  /// A text that may be left away; it is empty then. type: what stands for it in the help.
  void optional_text(const std::string& name, std::optional<std::string>& value,
                     const std::string& type, const std::string& help);
  /// May be repeated.
  void texts(const std::string& name, std::vector<std::string>& values, const std::string& help,
             bool required = false);
  /// May be repeated, or hold several between commas; with words: only these.
  void list(const std::string& name, std::vector<std::string>& values, const std::string& help,
            const std::vector<std::string>& words = {});

  // Numbers within bounds.
  void number(const std::string& name, int& value, int least, int most, const std::string& help);
  void number(const std::string& name, std::optional<int>& value, int least, int most,
              const std::string& help);
  void number(const std::string& name, std::uint32_t& value, std::uint32_t least,
              std::uint32_t most, const std::string& help);
  void number(const std::string& name, std::optional<std::uint32_t>& value, std::uint32_t least,
              std::uint32_t most, const std::string& help);
  void number(const std::string& name, float& value, float least, float most,
              const std::string& help);
  void number(const std::string& name, double& value, double least, double most,
              const std::string& help);
  void number(const std::string& name, std::optional<double>& value, double least, double most,
              const std::string& help);

  /// One of the words; set is called with it.
  void word(const std::string& name, const std::vector<std::string>& words,
            const std::string& default_word, const std::function<void(const std::string&)>& set,
            const std::string& help);
  /// The value of an enumeration by one of its first `count` words.
  template <typename Words, typename Value>
  void word(const std::string& name, Value& value, const Words& words, const std::string& help,
            std::size_t count = Words().size()) {
    word(
        name, names_of(words, count), default_word(words, value),
        [&value, &words](const std::string& w) { value = value_of(words, w).value(); }, help);
  }

  /// Options from now on stand under this heading in the help.
  void group(const std::string& heading) { group_ = heading; }
  /// Replaces the help of an option.
  void describe(const std::string& name, const std::string& help);
  [[nodiscard]] bool is_given(const std::string& name) const;

  /// What the command does, once all options have their values. Adds the options of the limits,
  /// which come last.
  void action(std::function<ExitCode()> run);

 private:
  template <typename Words, typename Value>
  static std::string default_word(const Words& words, const Value& value) {
    return word_of(words, value);
  }
  template <typename Words, typename Value>
  static std::string default_word(const Words& words, const std::optional<Value>& value) {
    return value ? word_of(words, *value) : "";
  }
  CLI::Option& finish(CLI::Option* option);
  template <typename Target, typename Number>
  void add_number(const std::string& name, Target& value, Number least, Number most,
                  const std::string& help);

  CLI::App* app_;
  std::function<ExitCode()>* chosen_;
  Limits* limits_;
  std::string group_;
};

/// The program's subcommands.
class CommandLine {
 public:
  CommandLine(const std::string& description, const std::string& version);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  Command add(const std::string& name, const std::string& help);

  /// All commands with their options.
  [[nodiscard]] ProgramManual manual() const;

  /// Runs the subcommand that the arguments name. Throws InputError for arguments that cannot be
  /// understood.
  ExitCode run(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> app_;
  std::unique_ptr<Limits> limits_;
  std::function<ExitCode()> chosen_;
};

}  // namespace facet::cli
