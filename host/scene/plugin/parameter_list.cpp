#include "scene/plugin/parameter_list.h"

#include <algorithm>
#include <array>

namespace facet {

std::string default_text(const Color& value) {
  if (value == Color(value.r)) return fmt::format("{}", value.r);
  return fmt::format("{}, {}, {}", value.r, value.g, value.b);
}

std::string default_text(const std::string& value) { return value; }

std::string default_text(const dmat4& value) { return value == dmat4(1) ? "identity" : ""; }

std::string table_of(const std::vector<ParameterInfo>& parameters) {
  if (parameters.empty()) return "";
  using Row = std::array<std::string, 4>;
  std::vector<Row> rows{{"parameter", "values", "default", "meaning"}};
  for (const ParameterInfo& p : parameters)
    rows.push_back(
        {p.name, p.range.empty() ? p.type : p.type + ", " + p.range, p.fallback, p.meaning});
  std::array<std::size_t, 4> widths{};
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text = "\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t i = 0; i < widths.size(); ++i)
      text += fmt::format("| {:<{}} ", rows[r][i], widths[i]);
    text += "|\n";
    if (r > 0) continue;
    for (const std::size_t width : widths) text += "|" + std::string(width + 2, '-');
    text += "|\n";
  }
  return text;
}

}  // namespace facet
