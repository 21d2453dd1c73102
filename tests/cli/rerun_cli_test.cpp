// The commands that reports print render the same value again.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/program.h"
#include "image/files.h"
#include "image/record.h"

namespace facet::test {
namespace {

using Words = std::vector<std::string>;

/// Every option that decides about an image's values, away from what the scene or the program would
/// choose.
const std::map<std::string, std::string>& options() {
  static const std::map<std::string, std::string> list{{"--integrator", "path_mis"},
                                                       {"--sampler", "zsobol"},
                                                       {"--spp", "11"},
                                                       {"--max-depth", "3"},
                                                       {"--heuristic", "power"},
                                                       {"--emitter-selection", "uniform"},
                                                       {"--area-sampling", "solidangle"},
                                                       {"--environment-sampling", "radiance"},
                                                       {"--emitter-candidates", "3"},
                                                       {"--masking", "exact"},
                                                       {"--sampling", "ndf"},
                                                       {"--sample-range", "3:9"},
                                                       {"--seed", "7"},
                                                       {"--backend", "reference"},
                                                       {"--precision", "double"}};
  return list;
}

/// A rough scene under two lamps of unlike powers, in a folder and a file whose names a shell must
/// not read.
class RerunCliTest : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    folder_.write("lamp.obj", "v 0.5 1 -0.5\nv 0.7 1 -0.5\nv 0.7 1 0\nv 0.5 1 0\nf 1 2 3 4\n");
    const std::string metal =
        R"(<bsdf type="roughconductor"><float name="alpha" value="0.4"/></bsdf>)";
    const std::string bright =
        R"(<emitter type="area"><color name="radiance" value="9, 7, 5"/></emitter>)";
    write_scene(scene_, mesh("floor.obj", metal) + light() + mesh("lamp.obj", bright));
  }

  /// `facet render` with the options but those that are left out.
  [[nodiscard]] Words render(const std::string& output,
                             const std::set<std::string>& without) const {
    Words words{"render", "--resolution", "12x10", "-o", output};
    for (const auto& [option, value] : options()) {
      if (!without.contains(option)) words.push_back(option + "=" + value);
    }
    words.insert(words.end(), {"--", scene_});
    return words;
  }

  /// What the first pixels of a comparison with a black image say, and what their commands print.
  void expect_same_value(const std::string& image) {
    Image black(12, 10, {"R", "G", "B"});
    write_exr(folder_.file("black.exr"), black);
    const Result compared = run({"compare", image, "black.exr", "--json", "-"});
    ASSERT_EQ(compared.code, 0) << compared.err;
    const nlohmann::json worst = nlohmann::json::parse(compared.out)["worst"];
    ASSERT_GE(worst.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
      expect_pixel(worst[i]["image_command"], worst[i]["pixel"], worst[i]["image"]);
  }

  void expect_pixel(std::string command, const nlohmann::json& pixel,
                    const std::vector<float>& color) {
    ASSERT_TRUE(command.starts_with("facet render ")) << command;
    command.replace(0, 5, "'" + std::string(FACET_PROGRAM) + "'");
    const Result value = finish(start_command({"sh", "-c", command}));
    ASSERT_EQ(value.code, 0) << command << '\n' << value.err;
    EXPECT_EQ(value.out, fmt::format("pixel {},{}: {:.9g} {:.9g} {:.9g}\n", pixel[0].get<int>(),
                                     pixel[1].get<int>(), color[0], color[1], color[2]))
        << command;
  }

  const std::string scene_ = "-the lab's $scene.xml";
};

TEST_F(RerunCliTest, EveryOptionIsTried) {
  for (const RecordField& field : record_fields()) {
    if (field.option == nullptr) continue;
    EXPECT_TRUE(options().contains(field.option)) << field.option;
  }
}

TEST_F(RerunCliTest, EveryOptionIsRecorded) {
  ASSERT_EQ(run({"render", "-o", "plain.exr", "--", scene_}).code, 0);
  ASSERT_EQ(run(render("a.exr", {})).code, 0);
  const Metadata plain = read_exr(folder_.file("plain.exr")).metadata;
  const Metadata changed = read_exr(folder_.file("a.exr")).metadata;
  for (const RecordField& field : record_fields()) {
    if (field.option == nullptr) continue;
    const std::string* before = find_metadata(plain, field.key);
    const std::string* after = find_metadata(changed, field.key);
    ASSERT_NE(after, nullptr) << field.key;
    EXPECT_EQ(*after, options().at(field.option));
    EXPECT_NE(before == nullptr ? "" : *before, *after) << field.key;
  }
}

TEST_F(RerunCliTest, TheReferenceRendersTheSameValueAgain) {
  ASSERT_EQ(run(render("a.exr", {})).code, 0);
  expect_same_value("a.exr");
}

TEST_F(RerunCliTest, TheKernelsRenderTheSameValueAgain) {
  ASSERT_EQ(run(render("a.exr", {"--backend", "--precision"})).code, 0);
  expect_same_value("a.exr");
  // What no option says follows the scene, then and now.
  ASSERT_EQ(run({"render", "-o", "b.exr", "--resolution", "12x10", "--", scene_}).code, 0);
  expect_same_value("b.exr");
}

// A pixel by itself is not adaptive; its number of samples stands in the image.
TEST_F(RerunCliTest, APixelOfAnAdaptiveImageHasItsOwnNumberOfSamples) {
  for (const char* backend : {"vulkan", "reference"}) {
    Words words = render("a.exr", {"--sample-range", "--spp", "--backend", "--precision"});
    words.insert(words.begin() + 1, {"--adaptive", "--spp=32", "--backend", backend});
    ASSERT_EQ(run(words).code, 0);
    const Image image = read_exr(folder_.file("a.exr"));
    const int samples = image.find_channel("samples");
    ASSERT_GE(samples, 0);
    const auto [least, most] =
        std::minmax_element(image.plane(samples), image.plane(samples) + 120);
    EXPECT_LT(*least, *most);
    expect_same_value("a.exr");
  }
}

// One sample of this scene lies so near an edge that kernels and reference decide otherwise.
TEST_F(RerunCliTest, ParitysCommandRendersTheSampleAgain) {
  const std::string scene = std::string(FACET_SCENES) + "/furnace/furnace_050.xml";
  Words words{"parity", "--resolution=64x48", "--spp=4", "--json=-", "--quiet"};
  for (const auto& [option, value] : options()) {
    const bool foreign = option == "--backend" || option == "--precision";
    const bool changes_samples = option == "--sample-range" || option == "--spp" ||
                                 option == "--seed" || option == "--integrator" ||
                                 option == "--max-depth" || option == "--emitter-selection";
    if (!foreign && !changes_samples) words.push_back(option + "=" + value);
  }
  words.push_back(scene);
  const Result result = run(words);
  ASSERT_EQ(result.code, 0) << result.err;
  const nlohmann::json diverged = nlohmann::json::parse(result.out)["diverged"];
  ASSERT_FALSE(diverged.empty());
  expect_pixel(diverged[0]["command"], diverged[0]["pixel"], diverged[0]["kernels"]);
}

}  // namespace
}  // namespace facet::test
