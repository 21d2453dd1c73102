#include "report/extremes_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/text_file.h"
#include "report/page.h"
#include "report/pages/page_text.h"
#include "version.h"

namespace facet::report {

namespace {

const char* verdict_of(const extremes::Row& row) {
  if (row.holds()) return "holds";
  return row.fails() ? "FAILS" : "argued";
}

std::string count_text(std::uint64_t count) {
  if (count < 10000) return fmt::format("{}", count);
  return fmt::format("{:.3g}", static_cast<double>(count));
}

}  // namespace

std::string text_of(const extremes::Row& row) {
  const extremes::Check& check = row.check;
  const extremes::Finding& found = row.finding;
  std::string text =
      fmt::format("{:6}  {:38} {:>9} inputs  worst {:.4g} of {:.4g} {}\n", verdict_of(row),
                  check.name, count_text(found.inputs), found.worst, check.limit, check.unit);
  if (!row.holds() || !check.argued.empty()) {
    text += fmt::format("        inputs: {}; the worst one: {}\n", check.range, found.at);
    if (!row.holds() && !check.promise.empty())
      text += fmt::format("        so this does not hold here: {}\n", check.promise);
    if (!check.argued.empty()) text += fmt::format("        {}\n", check.argued);
  }
  return text;
}

std::string summary_of(const extremes::Table& table) {
  const auto count = [&](auto predicate) {
    return std::count_if(table.rows.begin(), table.rows.end(), predicate);
  };
  const auto held = count([](const extremes::Row& row) { return row.holds(); });
  const auto failed = count([](const extremes::Row& row) { return row.fails(); });
  return fmt::format(
      "{} of {} rows hold, {} are argued, {} fail; {}, {}{}\n", held, table.rows.size(),
      static_cast<std::ptrdiff_t>(table.rows.size()) - held - failed, failed, table.device,
      table.driver, table.quick ? "; of a sample of the inputs (--quick)" : "");
}

nlohmann::ordered_json extremes_json(const extremes::Table& table) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const extremes::Row& row : table.rows) {
    rows.push_back({{"group", row.check.group},
                    {"name", row.check.name},
                    {"range", row.check.range},
                    {"inputs", row.finding.inputs},
                    {"worst", row.finding.worst},
                    {"at", row.finding.at},
                    {"limit", row.check.limit},
                    {"unit", row.check.unit},
                    {"holds", row.holds()},
                    {"argued", row.check.argued},
                    {"promise", row.check.promise},
                    {"seconds", row.seconds}});
  }
  return {{"device", table.device}, {"driver", table.driver},     {"version", FACET_VERSION},
          {"quick", table.quick},   {"complete", table.complete}, {"rows", std::move(rows)}};
}

void write_extremes_page(const std::string& path, const extremes::Table& table) {
  write_text(path, make_page(page_text::extremes_html, {page_text::page_css},
                             {page_text::draw_js, page_text::extremes_js}, extremes_json(table)));
}

}  // namespace facet::report
