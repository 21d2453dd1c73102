#include "cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/limits.h"
#include "core/error.h"
#include "core/text.h"
#include "version.h"

namespace facet::cli {

namespace {

template <typename Number>
std::string describe_bounds(Number least, Number most) {
  const char* kind = std::is_integral_v<Number> ? "an integer" : "a number";
  if constexpr (std::is_floating_point_v<Number>) {
    if (std::isinf(most)) return fmt::format("{} of at least {:g}", kind, least);
    return fmt::format("{} from {:g} to {:g}", kind, least, most);
  } else {
    return fmt::format("{} from {} to {}", kind, least, most);
  }
}

/// Nothing where the text is no such number.
template <typename Number>
std::optional<Number> parse_number(const std::string& text, Number least, Number most) {
  if constexpr (std::is_integral_v<Number>) {
    const auto value = parse_integer(text);
    if (!value || *value < least || *value > most) return std::nullopt;
    return static_cast<Number>(*value);
  } else {
    const auto value = parse_real(text);
    if (!value || *value < static_cast<double>(least) || *value > static_cast<double>(most))
      return std::nullopt;
    return static_cast<Number>(*value);
  }
}

template <typename Number>
std::string shown(const Number& value) {
  return fmt::format("{}", value);
}
template <typename Number>
std::string shown(const std::optional<Number>& /*value*/) {
  return "";
}

/// The message for a command line that cannot be parsed.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error,
                          const std::string& first) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  if (first.starts_with('-'))
    return fmt::format("unknown option \"{}\"; \"facet --help\" lists what there is", first);
  if (first.empty() || std::find(known.begin(), known.end(), first) != known.end()) {
    return fmt::format("{}; \"facet {}--help\" lists what there is", error.what(),
                       first.empty() ? "" : first + " ");
  }
  return fmt::format("unknown command \"{}\"{}", first, did_you_mean(first, known));
}

/// The words in "TEXT:{balance,power}", and what stands before them.
void read_type(const std::string& type, OptionManual& manual) {
  const std::size_t brace = type.find(":{");
  manual.value = type.substr(0, brace);
  if (brace == std::string::npos) return;
  const std::string list = type.substr(brace + 2, type.size() - brace - 3);
  for (const std::string_view word : split_list(list)) manual.words.emplace_back(word);
}

OptionManual manual_of(const CLI::Option& option) {
  OptionManual manual;
  manual.is_argument = option.get_positional();
  if (manual.is_argument) manual.names.push_back(option.get_name());
  for (const std::string& name : option.get_snames()) manual.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) manual.names.push_back("--" + name);
  if (option.get_items_expected_max() > 0) read_type(option.get_type_name(), manual);
  manual.default_value = option.get_default_str();
  manual.help = option.get_description();
  manual.is_required = option.get_required();
  manual.is_repeated = option.get_items_expected_max() > 1;
  return manual;
}

CommandManual manual_of(const CLI::App& command) {
  CommandManual manual{command.get_name(), command.get_description(), {}};
  for (const CLI::Option* option : command.get_options()) {
    if (option == command.get_help_ptr()) continue;
    const std::string heading = option->get_group() == "Options" ? "" : option->get_group();
    auto group = std::ranges::find(manual.groups, heading, &OptionGroup::heading);
    if (group == manual.groups.end()) group = manual.groups.insert(group, OptionGroup{heading, {}});
    group->options.push_back(manual_of(*option));
  }
  return manual;
}

}  // namespace

CLI::Option& Command::finish(CLI::Option* option) {
  if (!group_.empty()) option->group(group_);
  return *option;
}

void Command::argument(const std::string& name, std::string& value, const std::string& help,
                       bool required) {
  finish(app_->add_option(name, value, help)).required(required);
}

void Command::arguments(const std::string& name, std::vector<std::string>& values,
                        const std::string& help, bool required) {
  finish(app_->add_option(name, values, help)).required(required);
}

void Command::flag(const std::string& name, bool& value, const std::string& help) {
  finish(app_->add_flag(name, value, help));
}

void Command::text(const std::string& name, std::string& value, const std::string& help) {
  finish(app_->add_option(name, value, help)).default_str(value);
}

void Command::text(const std::string& name, std::optional<std::string>& value,
                   const std::string& help) {
  finish(app_->add_option(name, value, help));
}

void Command::path(const std::string& name, std::filesystem::path& value, const std::string& help) {
  const auto set = [=, &value](const std::string& text) {
    // As of a variable of a shell's that is not set: no rule would be the opposite of what is
    // meant.
    if (text.empty()) throw CLI::ValidationError(name, "an empty path");
    value = text;
  };
  finish(app_->add_option_function<std::string>(name, set, help)).type_name("PATH");
}

void Command::optional_text(const std::string& name, std::optional<std::string>& value,
                            const std::string& type, const std::string& help) {
  finish(app_->add_option(name, value, help)).expected(0, 1)->type_name(type);
}

void Command::texts(const std::string& name, std::vector<std::string>& values,
                    const std::string& help, bool required) {
  finish(app_->add_option(name, values, help)).allow_extra_args(false)->required(required);
}

void Command::list(const std::string& name, std::vector<std::string>& values,
                   const std::string& help, const std::vector<std::string>& words) {
  CLI::Option& option = finish(app_->add_option(name, values, help));
  option.delimiter(',')->allow_extra_args(false);
  if (!words.empty()) option.check(CLI::IsMember(words));
}

template <typename Target, typename Number>
void Command::add_number(const std::string& name, Target& value, Number least, Number most,
                         const std::string& help) {
  const auto set = [=, &value](const std::string& text) {
    const auto number = parse_number(text, least, most);
    if (!number)
      throw CLI::ValidationError(
          name, fmt::format("\"{}\" is not {}", text, describe_bounds(least, most)));
    value = *number;
  };
  finish(app_->add_option_function<std::string>(name, set, help))
      .type_name(std::is_integral_v<Number> ? "INT" : "FLOAT")
      ->default_str(shown(value));
}

void Command::number(const std::string& name, int& value, int least, int most,
                     const std::string& help) {
  add_number(name, value, least, most, help);
}

void Command::number(const std::string& name, std::optional<int>& value, int least, int most,
                     const std::string& help) {
  add_number(name, value, least, most, help);
}

void Command::number(const std::string& name, std::uint32_t& value, std::uint32_t least,
                     std::uint32_t most, const std::string& help) {
  add_number(name, value, least, most, help);
}

void Command::number(const std::string& name, std::optional<std::uint32_t>& value,
                     std::uint32_t least, std::uint32_t most, const std::string& help) {
  add_number(name, value, least, most, help);
}

void Command::number(const std::string& name, float& value, float least, float most,
                     const std::string& help) {
  add_number(name, value, least, most, help);
}

void Command::number(const std::string& name, double& value, double least, double most,
                     const std::string& help) {
  add_number(name, value, least, most, help);
}

void Command::number(const std::string& name, std::optional<double>& value, double least,
                     double most, const std::string& help) {
  add_number(name, value, least, most, help);
}

void Command::word(const std::string& name, const std::vector<std::string>& words,
                   const std::string& default_word,
                   const std::function<void(const std::string&)>& set, const std::string& help) {
  finish(app_->add_option_function<std::string>(name, set, help))
      .check(CLI::IsMember(words))
      ->default_str(default_word);
}

void Command::describe(const std::string& name, const std::string& help) {
  app_->get_option(name)->description(help);
}

bool Command::is_given(const std::string& name) const { return app_->count(name) > 0; }

void Command::action(std::function<ExitCode()> run) {
  add_limit_options(*this, *limits_);
  app_->final_callback([&chosen = *chosen_, run = std::move(run)] { chosen = run; });
}

CommandLine::CommandLine(const std::string& description, const std::string& version)
    : app_(std::make_unique<CLI::App>(description, "facet")), limits_(std::make_unique<Limits>()) {
  app_->set_version_flag("--version", version, "Version, compiler and the Vulkan version needed");
  app_->require_subcommand(1);
}

CommandLine::~CommandLine() = default;

Command CommandLine::add(const std::string& name, const std::string& help) {
  return {*app_->add_subcommand(name, help), chosen_, *limits_};
}

ProgramManual CommandLine::manual() const {
  ProgramManual manual{app_->get_description(), FACET_VERSION, {}};
  for (const CLI::App* command : app_->get_subcommands({}))
    manual.commands.push_back(manual_of(*command));
  return manual;
}

ExitCode CommandLine::run(int argc, char** argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return static_cast<ExitCode>(app_->exit(error));
    throw InputError(usage_message(*app_, error, argc > 1 ? argv[1] : ""));
  }
  set_limits(*limits_);
  return chosen_();
}

}  // namespace facet::cli
