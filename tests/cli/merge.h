#pragma once
// Rendering parts and merging them.
#include "cli/program.h"
#include "image/files.h"
#include "image/record.h"

namespace facet::test {

using Names = std::vector<std::string>;

/// A lit metal floor under a filter with negative lobes.
class MergeCliTest : public CliTest {
 protected:
  static std::string with_filter(const std::string& filter) {
    return "<scene>" + camera(filter) + "\n<integrator type=\"path_mis\"/>\n" +
           mesh("floor.obj",
                "<bsdf type=\"roughconductor\"><float name=\"alpha\" value=\"0.3\"/></bsdf>") +
           light() + "</scene>\n";
  }

  void SetUp() override {
    CliTest::SetUp();
    folder_.write("scene.xml", with_filter("<rfilter type=\"mitchell\"/>"));
  }

  /// Renders a part of the samples.
  void part(const std::string& name, const std::string& range, Names options = {}) const {
    options.insert(options.end(), {"--sample-range", range});
    render(name, options);
  }
  void render(const std::string& name, Names options) const {
    options.insert(options.begin(), {"render", "--quiet", "-o", name});
    if (std::find(options.begin(), options.end(), "other.xml") == options.end())
      options.emplace_back("scene.xml");
    const Result result = run(options);
    ASSERT_EQ(result.code, 0) << result.err;
    ASSERT_EQ(result.err, "");
  }
  Image merge(Names options) const {
    options.insert(options.begin(), {"merge", "--quiet", "-o", "merged.exr"});
    const Result result = run(options);
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.out + result.err, "");
    return read("merged.exr");
  }
  [[nodiscard]] Image read(const std::string& name) const { return read_exr(folder_.file(name)); }

  void expect_refusal(const Names& parts, std::initializer_list<const char*> words) const {
    Names options{"merge", "-o", "none.exr"};
    options.insert(options.end(), parts.begin(), parts.end());
    expect_failure(options, 2, words);
    EXPECT_FALSE(std::filesystem::exists(folder_.file("none.exr")));
  }
};

inline std::string metadata(const Image& image, const std::string& name) {
  const std::string* text = find_metadata(image.metadata, name);
  return text == nullptr ? "no " + name : *text;
}

}  // namespace facet::test
