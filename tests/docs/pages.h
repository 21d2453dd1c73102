#pragma once
// The pages of the documentation, as text.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace facet::test {

struct Page {
  std::string name;  ///< path from the root of the sources
  std::vector<std::string> lines;
};

inline std::filesystem::path page_root() { return FACET_SOURCE; }

/// Every page: those at the root, those below docs, and each folder's README.
inline std::vector<Page> all_pages() {
  std::vector<Page> pages;
  const auto add = [&](const std::filesystem::path& file) {
    Page page{std::filesystem::relative(file, page_root()).string(), {}};
    std::ifstream text(file);
    for (std::string line; std::getline(text, line);) page.lines.push_back(line);
    pages.push_back(std::move(page));
  };
  for (const auto& entry : std::filesystem::directory_iterator(page_root())) {
    if (entry.path().extension() == ".md") add(entry.path());
  }
  for (const char* folder : {"docs", "scenes", "examples", "farm", "tests"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(page_root() / folder)) {
      if (entry.path().extension() == ".md") add(entry.path());
    }
  }
  std::ranges::sort(pages, {}, &Page::name);
  return pages;
}

/// A line with what it is part of.
struct PageLine {
  int number = 0;  ///< from 1 on
  std::string text;
  bool is_code = false;  ///< between fences or indented
  std::string language;  ///< of the fence; empty without one
};

/// The page's lines but for the fences themselves.
inline std::vector<PageLine> read_lines(const Page& page) {
  std::vector<PageLine> lines;
  bool fenced = false;
  bool blank_before = true;
  bool indented = false;
  std::string language;
  for (std::size_t i = 0; i < page.lines.size(); ++i) {
    const std::string& line = page.lines[i];
    const std::size_t start = line.find_first_not_of(' ');
    if (start != std::string::npos && line.compare(start, 3, "```") == 0) {
      fenced = !fenced;
      language = fenced ? line.substr(start + 3) : "";
      continue;
    }
    const bool blank = start == std::string::npos;
    if (!blank) indented = line.starts_with("    ") && (blank_before || indented);
    lines.push_back({static_cast<int>(i) + 1, line, fenced || (indented && !blank), language});
    blank_before = blank;
  }
  return lines;
}

}  // namespace facet::test
