// Links of the documentation lead somewhere, and its pages keep their form.
#include <gtest/gtest.h>

#include <cctype>
#include <map>
#include <regex>
#include <set>

#include "docs/pages.h"

namespace facet::test {
namespace {

/// What hosts make of a heading: lower case, without punctuation, hyphens for spaces.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80)
      anchor += static_cast<char>(std::tolower(byte));
    else if (c == ' ')
      anchor += '-';
  }
  return anchor;
}

std::set<std::string> anchors_of(const Page& page) {
  std::set<std::string> anchors;
  std::map<std::string, int> seen;
  for (const PageLine& line : read_lines(page)) {
    const std::size_t level = line.text.find_first_not_of('#');
    if (line.is_code || level == 0 || level == std::string::npos || line.text[level] != ' ')
      continue;
    const std::string anchor = anchor_of(line.text.substr(level + 1));
    const int count = seen[anchor]++;
    anchors.insert(count == 0 ? anchor : anchor + "-" + std::to_string(count));
  }
  return anchors;
}

/// All targets of a page's links and pictures. Links may be divided between lines.
std::vector<std::string> targets_of(const Page& page) {
  std::string text;
  for (const PageLine& line : read_lines(page)) {
    if (!line.is_code) text += line.text + '\n';
  }
  text = std::regex_replace(text, std::regex("`[^`]*`"), "code");
  const std::regex link(R"(\]\(([^)\s]+)\))");
  std::vector<std::string> targets;
  for (std::sregex_iterator i(text.begin(), text.end(), link), end; i != end; ++i)
    targets.push_back((*i)[1]);
  return targets;
}

bool is_elsewhere(const std::string& target) {
  return target.starts_with("http://") || target.starts_with("https://");
}

TEST(DocsLinks, lead_to_files_and_headings) {
  const std::vector<Page> pages = all_pages();
  std::map<std::string, std::set<std::string>> anchors;
  for (const Page& page : pages) anchors[page.name] = anchors_of(page);
  std::size_t count = 0;
  for (const Page& page : pages) {
    for (const std::string& target : targets_of(page)) {
      if (is_elsewhere(target)) continue;
      ++count;
      const std::size_t hash = target.find('#');
      const std::string file = target.substr(0, hash);
      const std::filesystem::path from = std::filesystem::path(page.name).parent_path();
      const std::string path = file.empty() ? page.name : (from / file).lexically_normal().string();
      EXPECT_TRUE(std::filesystem::exists(page_root() / path)) << page.name << ": " << target;
      if (hash != std::string::npos) {
        EXPECT_TRUE(anchors[path].contains(target.substr(hash + 1))) << page.name << ": " << target;
      }
    }
  }
  EXPECT_GT(count, 80U);
}

TEST(DocsLinks, every_page_is_reached_from_the_first) {
  const std::vector<Page> pages = all_pages();
  std::map<std::string, const Page*> by_name;
  for (const Page& page : pages) by_name[page.name] = &page;
  std::set<std::string> reached{"README.md"};
  std::vector<std::string> open{"README.md"};
  while (!open.empty()) {
    const Page& page = *by_name.at(open.back());
    open.pop_back();
    for (const std::string& target : targets_of(page)) {
      const std::string path =
          (std::filesystem::path(page.name).parent_path() / target.substr(0, target.find('#')))
              .lexically_normal()
              .string();
      if (by_name.contains(path) && reached.insert(path).second) open.push_back(path);
    }
  }
  for (const Page& page : pages) {
    if (page.name.starts_with("docs/")) {
      EXPECT_TRUE(reached.contains(page.name)) << page.name;
    }
  }
}

TEST(DocsLinks, the_first_page_is_short) {
  for (const Page& page : all_pages()) {
    if (page.name == "README.md") {
      EXPECT_LE(page.lines.size(), 90U);
    }
  }
}

/// Columns of a text, whose characters may take several bytes.
std::size_t columns(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// Pages that programs write.
bool is_generated(const Page& page) {
  const std::set<std::string> names{"docs/guide/command-line.md", "docs/reference/plugins.md",
                                    "docs/reference/extremes.md", "docs/reference/albedo.md"};
  return names.contains(page.name);
}

TEST(DocsLinks, lines_are_not_longer_than_a_hundred_columns) {
  for (const Page& page : all_pages()) {
    if (is_generated(page)) continue;
    for (const PageLine& line : read_lines(page)) {
      // Tables and code cannot be broken, nor can links.
      const bool breakable =
          !line.is_code && !line.text.starts_with('|') && line.text.find("](") == std::string::npos;
      if (breakable) {
        EXPECT_LE(columns(line.text), 100U) << page.name << ":" << line.number;
      }
    }
  }
}

}  // namespace
}  // namespace facet::test
