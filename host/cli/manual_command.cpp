// facet manual: all commands and options, for a page, for man, or for bash.
#include <array>
#include <memory>

#include "cli/commands.h"
#include "cli/manual.h"
#include "core/print.h"
#include "core/words.h"

namespace facet::cli {

namespace {

enum class ManualForm { man, markdown, bash };

constexpr std::array form_words{Word{ManualForm::man, "man"},
                                Word{ManualForm::markdown, "markdown"},
                                Word{ManualForm::bash, "bash"}};

std::string made(const ProgramManual& manual, ManualForm form) {
  switch (form) {
    case ManualForm::man:
      return man_page(manual);
    case ManualForm::markdown:
      return markdown_manual(manual);
    case ManualForm::bash:
      return bash_completion(manual);
  }
  return "";
}

}  // namespace

void add_manual_command(CommandLine& line) {
  const auto form = std::make_shared<ManualForm>(ManualForm::markdown);
  Command command =
      line.add("manual", "Print the manual of all commands, or what lets bash complete them");
  command.word("--form", *form, form_words,
               "man: for man(1); bash: completion, to be read by source");
  command.action([form, &line] {
    put_text(made(line.manual(), *form));
    return ExitCode::done;
  });
}

}  // namespace facet::cli
