// The kernels' source keeps out of traps that Mesa 22's lavapipe does not report: values that leave
// bottom-tested loops are wrong, and loops share one budget of iterations.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace facet {
namespace {

std::string read_without_comments(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return std::regex_replace(text.str(), std::regex(R"(//[^\n]*|/\*[^]*?\*/)"), "");
}

template <typename Body>
void for_each_shader(const Body& body) {
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(FACET_SHADERS)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".glsl" && extension != ".comp") continue;
    body(entry.path().filename().string(), read_without_comments(entry.path()));
    ++files;
  }
  EXPECT_GT(files, 20);
}

TEST(ShaderSource, loops_are_tested_at_their_top) {
  for_each_shader([](const std::string& name, const std::string& text) {
    EXPECT_FALSE(std::regex_search(text, std::regex(R"(\bdo\b)"))) << name;
    EXPECT_FALSE(std::regex_search(text, std::regex(R"(for\s*\([^;]*;\s*;)"))) << name;
    EXPECT_FALSE(std::regex_search(text, std::regex(R"(while\s*\(\s*true)"))) << name;
  });
}

TEST(ShaderSource, no_subgroup_operations) {
  for_each_shader([](const std::string& name, const std::string& text) {
    EXPECT_EQ(text.find("subgroup"), std::string::npos) << name;
  });
}

TEST(ShaderSource, main_functions_are_short) {
  for_each_shader([](const std::string& name, const std::string& text) {
    const std::size_t begin = text.find("void main()");
    if (begin == std::string::npos) return;
    EXPECT_LE(std::count(text.begin() + static_cast<std::ptrdiff_t>(begin), text.end(), '\n'), 42)
        << name;
  });
}

}  // namespace
}  // namespace facet
