#include "image/rerun.h"

#include <fmt/format.h>

#include <optional>

#include "core/text.h"

namespace facet {

std::string shell_word(const std::string& word) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:,+=";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  // Control characters would command the terminal that shows them.
  const bool by_printf = printable(word, word.size() + 1) != word;
  const auto is_plain_byte = [](char c) { return c >= 0x20 && c < 0x7f; };
  std::string result = "'";
  for (const char c : word) {
    if (c == '\'') {
      result += "'\\''";
    } else if (by_printf && !is_plain_byte(c)) {
      result += fmt::format("\\0{:03o}", static_cast<unsigned char>(c));
    } else {
      if (by_printf && c == '\\') result += c;
      result += c;
    }
  }
  result += '\'';
  return by_printf ? "\"$(printf %b " + result + ")\"" : result;
}

std::string rerun_command(const RenderRecord& record, const ImageSize& size, int x, int y) {
  return rerun_command(ParsedRecord{record, {}, {}}, size, x, y);
}

std::string rerun_command(const ParsedRecord& parsed, const ImageSize& size, int x, int y) {
  const RenderRecord& record = parsed.record;
  if (!parsed.damaged.empty() || record.scene.empty() || record.samples.list().size() > 1 ||
      record.adaptive)
    return "";
  std::string command =
      fmt::format("facet render --pixel={},{} --resolution={}x{}", x, y, size.width, size.height);
  for (const RecordField& field : record_fields()) {
    if (!is_chosen(field, record)) continue;
    const bool said = field.option != nullptr && !parsed.is_missing(field);
    const std::optional<std::string> value = said ? field.read(record) : std::nullopt;
    // Joined by =, since a value may begin with a minus.
    if (value) command += fmt::format(" {}={}", field.option, shell_word(*value));
  }
  // A name may begin with a minus.
  return command + " -- " + shell_word(record.scene);
}

std::string setting_options(const RenderRecord& record, std::string_view without) {
  std::string options;
  for (const RecordField& field : record_fields()) {
    const bool said = field.option != nullptr && field.common && is_chosen(field, record) &&
                      field.option != without;
    const std::optional<std::string> value = said ? field.read(record) : std::nullopt;
    // Joined by =, since a value may begin with a minus.
    if (value) options += fmt::format(" {}={}", field.option, shell_word(*value));
  }
  return options;
}

std::vector<std::string> options_between(const RenderRecord& from, const RenderRecord& to) {
  std::vector<std::string> options;
  for (const RecordField& field : record_fields()) {
    if (field.option == nullptr || !is_chosen(field, to)) continue;
    const std::optional<std::string> value = field.read(to);
    if (!value || value == field.read(from)) continue;
    options.emplace_back(field.option);
    options.push_back(*value);
  }
  // A pixel of an adaptive render has no command of its own, and the table no option for it.
  if (to.adaptive && !from.adaptive) options.emplace_back("--adaptive");
  return options;
}

}  // namespace facet
