#pragma once
// Pages with a script added that drives their controls and tells what it finds.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "cli/browser.h"

namespace facet::test {

inline std::string text_of_file(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Results of a script at the end of a copy of the page: it ends in page_report.js, which reports
/// its object `results`, and `problems`, the errors of all scripts from the start.
inline nlohmann::json look_at(const std::string& browser, const std::filesystem::path& page,
                              const std::filesystem::path& script,
                              const std::string& options = "") {
  constexpr std::string_view listener =
      "<script>const problems = [];"
      "window.addEventListener('error', (event) => problems.push(String(event.message)));"
      "document.addEventListener('securitypolicyviolation', (event) => "
      "problems.push(event.blockedURI));</script>";
  std::string text = text_of_file(page);
  text.insert(text.find("<title>"), listener);
  text.insert(text.rfind("</body>"), "<script>" + text_of_file(script) +
                                         text_of_file(script.parent_path() / "page_report.js") +
                                         "</script>");
  const std::filesystem::path copy = page.parent_path() / "copy.html";
  std::ofstream(copy, std::ios::binary) << text;
  const std::string dom = dump_dom(browser, copy, options);
  const std::size_t begin = dom.find("BEGIN", dom.find("id=\"report\""));
  const std::size_t end = dom.find("END", begin);
  if (end == std::string::npos) {
    ADD_FAILURE() << "the page's script did not reach its end: " << dom.substr(0, 2000);
    return {};
  }
  std::string json;
  for (std::size_t i = begin + 5; i + 1 < end; i += 2)
    json += static_cast<char>(std::stoi(dom.substr(i, 2), nullptr, 16));
  return nlohmann::json::parse(json);
}

}  // namespace facet::test
