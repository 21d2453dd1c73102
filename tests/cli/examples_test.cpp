// The programs of examples/, as a reader would run them.
#include <cmath>

#include "cli/program.h"
#include "image/files.h"
#include "image/record.h"

namespace facet::test {
namespace {

class ExamplesTest : public CliTest {
 protected:
  [[nodiscard]] Result example(const std::string& name, std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), std::string(FACET_EXAMPLES) + "/" + name);
    return finish(start_command(std::move(arguments)));
  }
};

TEST_F(ExamplesTest, RenderIsFacetRender) {
  const Result result = example("render", {"scene.xml", "a.exr", "a.png"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder_.file("a.png")));
  ASSERT_EQ(run({"render", "scene.xml", "-o", "b.exr"}).code, 0);
  const Result same = run({"compare", "a.exr", "b.exr", "--min-identical", "1"});
  EXPECT_EQ(same.code, 0) << same.out << same.err;
  EXPECT_EQ(*find_metadata(read_exr(folder_.file("a.exr")).metadata, "facet.spp"), "4");
  const Result missing = example("render", {"none.xml", "a.exr"});
  EXPECT_EQ(missing.code, 1);
  expect_words(missing.err, {"none.xml: no such file"});
}

TEST_F(ExamplesTest, CompareTellsHowFarTheyAre) {
  const Result result = example("compare", {"scene.xml", "16"});
  ASSERT_EQ(result.code, 0) << result.err;
  expect_words(result.err, {"100 %"});
  expect_words(result.out, {"RMSE 0.", "relMSE 0.", "FLIP 0."});
}

TEST_F(ExamplesTest, ASceneInMemoryIsLit) {
  const Result result = example("scene_in_memory", {"pyramid.png"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Image image = read_image(folder_.file("pyramid.png"));
  ASSERT_EQ(image.width(), 160);
  ASSERT_EQ(image.height(), 120);
  // Copper is red, and the floor below the lamp grey; the corner above is black.
  EXPECT_GT(image.at(80, 60, 0), 2 * image.at(80, 60, 2));
  EXPECT_GT(image.at(80, 110, 1), 0.01F);
  EXPECT_EQ(image.at(0, 0, 0), 0);
}

TEST_F(ExamplesTest, PerSampleShowsThreeThatAreAlike) {
  const Result result = example("per_sample", {"scene.xml", "8", "12", "5"});
  ASSERT_EQ(result.code, 0) << result.err;
  std::istringstream lines(result.out);
  std::string head;
  std::getline(lines, head);
  expect_words(head, {"CPU reference in float", "CPU reference in double"});
  int samples = 0;
  bool lit = false;
  for (int number = 0; lines >> number; ++samples) {
    std::array<double, 9> values{};
    for (double& v : values) lines >> v;
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(values.at(c), values.at(6 + c), 1e-4 * values.at(6 + c)) << head << result.out;
      EXPECT_NEAR(values.at(3 + c), values.at(6 + c), 1e-4 * values.at(6 + c));
      lit = lit || values.at(c) > 0;
    }
  }
  EXPECT_EQ(samples, 5);
  EXPECT_TRUE(lit);
}

}  // namespace
}  // namespace facet::test
