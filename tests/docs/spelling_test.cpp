// The documentation's words are those of a dictionary (GNU Aspell's British English), or of
// words.txt beside this file.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <set>

#include "docs/pages.h"

namespace facet::test {
namespace {

std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> buffer{};
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
    text.append(buffer.data(), count);
  ::pclose(pipe);
  return text;
}

TEST(DocsSpelling, of_every_page) {
  if (output_of("command -v aspell").empty() ||
      output_of("aspell dicts").find("en_GB") == std::string::npos)
    GTEST_SKIP() << "needs aspell and aspell-en";
  const std::string words = (page_root() / "tests/docs/words.txt").string();
  for (const Page& page : all_pages()) {
    std::istringstream unknown(output_of("aspell --lang=en_GB --mode=markdown --personal=" + words +
                                         " list < '" + (page_root() / page.name).string() + "'"));
    std::set<std::string> distinct;
    for (std::string word; std::getline(unknown, word);) distinct.insert(word);
    for (const std::string& word : distinct) ADD_FAILURE() << page.name << ": " << word;
  }
  // It would find something.
  EXPECT_EQ(output_of("echo 'a mistaek' | aspell --lang=en_GB --mode=markdown --personal=" + words +
                      " list"),
            "mistaek\n");
}

}  // namespace
}  // namespace facet::test
