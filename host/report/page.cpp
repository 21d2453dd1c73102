#include "report/page.h"

#include <nlohmann/json.hpp>

#include "report/pages/page_text.h"

namespace facet::report {

namespace {

std::string joined(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) text += part;
  return text;
}

/// Replaces the one {{name}}.
void fill(std::string& page, const std::string& name, const std::string& text) {
  const std::string mark = "{{" + name + "}}";
  page.replace(page.find(mark), mark.size(), text);
}

/// JSON that no HTML parser takes for the end of its element, or for a comment.
std::string embeddable(const nlohmann::ordered_json& data) {
  const std::string text = data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string result;
  result.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      result += "\\u003c";
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace

std::string make_page(std::string_view body, std::initializer_list<std::string_view> styles,
                      std::initializer_list<std::string_view> scripts,
                      const nlohmann::ordered_json& data) {
  std::string page(page_text::frame_html);
  fill(page, "body", std::string(body));
  // The data last: nothing is looked for in it.
  fill(page, "style", joined(styles));
  fill(page, "script", "(() => {\n\"use strict\";\n" + joined(scripts) + "})();\n");
  fill(page, "data", embeddable(data));
  return page;
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8U | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      result += k <= count ? digits[word >> (18 - 6 * k) & 63U] : '=';
  }
  return result;
}

}  // namespace facet::report
