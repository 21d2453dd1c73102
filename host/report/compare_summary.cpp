#include "report/compare_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <sstream>

#include "core/text.h"
#include "report/compare_report.h"

namespace facet::report {

namespace {

/// Squares along the longer side of the image.
constexpr int most_squares = 24;

/// Without control characters, and with "?" for whatever is no character of UTF-8: readers of XML
/// refuse a whole report for one.
std::string valid_text(const std::string& text) {
  const std::string clean = printable(text);
  std::string result;
  for (std::size_t i = 0; i < clean.size();) {
    const auto lead = static_cast<unsigned char>(clean[i]);
    const std::size_t length = lead < 0x80                   ? 1
                               : lead >= 0xC2 && lead < 0xE0 ? 2
                               : lead >= 0xE0 && lead < 0xF0 ? 3
                               : lead >= 0xF0 && lead < 0xF5 ? 4
                                                             : 0;
    bool is_valid = length > 0 && i + length <= clean.size();
    for (std::size_t k = 1; is_valid && k < length; ++k)
      is_valid = (static_cast<unsigned char>(clean[i + k]) & 0xC0U) == 0x80U;
    result += is_valid ? clean.substr(i, length) : "?";
    i += is_valid ? length : 1;
  }
  return result;
}

/// Names are strangers': nothing of them is taken for Markdown or HTML.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : valid_text(text)) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      default:
        if (std::string_view("\\`*_{}[]()#+!|~").find(c) != std::string_view::npos) result += '\\';
        result += c;
    }
  }
  return result;
}

/// The pixels of one square, and the root mean square of their relative errors.
struct Square {
  std::size_t pixels = 0;
  std::size_t nonfinite = 0;
  double terms = 0;

  [[nodiscard]] const char* symbol() const {
    if (nonfinite > 0) return "🟪";
    const double error = std::sqrt(terms / static_cast<double>(std::max<std::size_t>(pixels, 1)));
    if (error == 0) return "⬜";
    return error < 0.01 ? "🟩" : error < 0.1 ? "🟨" : error < 1 ? "🟧" : "🟥";
  }
};

constexpr const char* legend =
    "Relative error: ⬜ none, 🟩 below 1 %, 🟨 below 10 %, 🟧 below 100 %, 🟥 above; 🟪 "
    "not finite.";

/// A line a row of squares.
std::string error_map(const Comparison& c) {
  const int width = c.image.width();
  const int height = c.image.height();
  const int longer = std::max(width, height);
  const auto count = [&](int side) {
    const int squares = std::min(longer, most_squares);
    return std::clamp((side * squares + longer / 2) / longer, 1, side);
  };
  const int columns = count(width);
  const int rows = count(height);
  std::vector<Square> squares(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto place = static_cast<std::size_t>((y * rows / height) * columns) +
                         static_cast<std::size_t>(x * columns / width);
      Square& square = squares[place];
      const double term =
          c.errors.terms[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x)];
      if (std::isfinite(term)) {
        ++square.pixels;
        square.terms += term;
      } else {
        ++square.nonfinite;
      }
    }
  }
  std::string text;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    text += squares[i].symbol();
    if ((i + 1) % static_cast<std::size_t>(columns) == 0) text += '\n';
  }
  return text;
}

}  // namespace

std::string comparison_markdown(const CompareOptions& options, const Comparison& c) {
  const std::vector<std::string> violations = c.violations();
  const char* verdict = c.thresholds.empty() ? "" : violations.empty() ? "✅ " : "❌ ";
  std::string text = fmt::format("### {}{} against {}\n\n", verdict, escaped(options.image),
                                 escaped(options.reference));
  for (const std::string& line : violations) text += "- **" + escaped(line) + "**\n";
  for (const std::string& line : c.warnings) text += "- warning: " + escaped(line) + "\n";
  if (!violations.empty() || !c.warnings.empty()) text += '\n';
  text += "| figure | value | |\n|---|---|---|\n";
  for (const MetricRow& row : metric_rows(options, c))
    text += fmt::format("| {} | {} | {} |\n", row.name, escaped(row.value), escaped(row.note));
  return text + fmt::format("\n```text\n{}```\n\n{}\n\n", error_map(c), legend);
}

std::string comparison_junit(const CompareOptions& options, const Comparison& c) {
  pugi::xml_document document;
  document.append_child(pugi::node_declaration).append_attribute("version") = "1.0";
  pugi::xml_node suite = document.append_child("testsuites").append_child("testsuite");
  const auto add = [&](const std::string& name) {
    pugi::xml_node one = suite.append_child("testcase");
    one.append_attribute("classname") = valid_text(options.image).c_str();
    one.append_attribute("name") = name.c_str();
    return one;
  };
  suite.append_attribute("name") =
      valid_text(fmt::format("{} against {}", options.image, options.reference)).c_str();
  suite.append_attribute("tests") = std::max<std::size_t>(c.thresholds.size(), 1);
  suite.append_attribute("failures") = c.violations().size();
  if (c.thresholds.empty()) add("compared");
  for (const Threshold& threshold : c.thresholds) {
    pugi::xml_node one = add(threshold.name);
    if (!threshold.violation.empty())
      one.append_child("failure").append_attribute("message") = threshold.violation.c_str();
  }
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

}  // namespace facet::report
