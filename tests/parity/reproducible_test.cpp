// Every shipped scene gives the same image in every bit, whatever runs the kernels: any number of
// the driver's threads, another version of the driver, any size of pass, and any part of the image
// or of the samples at a time. Scenes are looked for when the test runs, so that a new one is
// covered at once.
#include <array>
#include <bit>
#include <cmath>

#include "cli/program.h"
#include "image/files.h"
#include "support/parity.h"

namespace facet::test {
namespace {

using Words = std::vector<std::string>;

constexpr int width = 48;
constexpr int height = 36;

std::string metadata(const Image& image, const std::string& name) {
  for (const auto& [key, value] : image.metadata) {
    if (key == name) return value;
  }
  return "no " + name;
}

/// Expects every channel to have equal bits, and the image to show something.
void expect_equal_bits(const Image& a, const Image& b) {
  ASSERT_EQ(a.channels(), b.channels());
  ASSERT_EQ(a.channels().size(), 8U);
  const auto count = std::size_t{width} * std::size_t{height};
  for (int c = 0; c < 8; ++c) {
    std::size_t different = 0;
    std::size_t nonzero = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const float x = a.plane(c)[i];
      different +=
          std::bit_cast<std::uint32_t>(x) != std::bit_cast<std::uint32_t>(b.plane(c)[i]) ? 1 : 0;
      nonzero += x != 0 ? 1 : 0;
    }
    const std::string& channel = a.channels()[static_cast<std::size_t>(c)];
    EXPECT_EQ(different, 0U) << "values of " << channel << " differ, of " << count;
    if (!channel.starts_with("variance")) {
      EXPECT_GT(nonzero, 10U) << channel;
    }
  }
}

/// Renders shipped scenes with the program, as users do.
class Reproducible : public CliTest {
 protected:
  /// One image for each list of words, which stand before the program's own. All run at the same
  /// time and share their files of output, which stay empty.
  std::vector<Image> render(const std::string& scene, const char* sampling,
                            const std::vector<Words>& before) const {
    std::vector<pid_t> children;
    for (Words words : before) {
      const Words own{FACET_PROGRAM,
                      "render",
                      std::string(FACET_SCENES) + "/" + scene,
                      "--quiet",
                      "--spp",
                      "4",
                      "--resolution",
                      "48x36",
                      "--aov",
                      "variance",
                      "--sampling",
                      sampling,
                      "-o",
                      output(children.size())};
      words.insert(words.end(), own.begin(), own.end());
      children.push_back(start_command(words));
    }
    std::vector<Image> images;
    for (const pid_t child : children) {
      const Result result = finish(child);
      EXPECT_EQ(result.code, 0);
      EXPECT_EQ(result.err, "");
      images.push_back(read_exr(folder_.file(output(images.size()))));
      std::filesystem::remove(folder_.file(output(images.size() - 1)));
    }
    return images;
  }

 private:
  static std::string output(std::size_t way) { return std::to_string(way) + ".exr"; }
};

TEST_F(Reproducible, any_number_of_driver_threads) {
  for (const std::string& scene : shipped_scenes()) {
    SCOPED_TRACE(scene);
    const std::vector<Image> images =
        render(scene, "visible", {{"env", "LP_NUM_THREADS=1"}, {"env", "LP_NUM_THREADS=7"}});
    expect_equal_bits(images[0], images[1]);
  }
}

TEST_F(Reproducible, another_version_of_the_driver) {
  const Words second{"sh", FACET_SECOND_DRIVER_SCRIPT};
  const Result check = finish(start_command({second[0], second[1], "--check"}));
  if (check.code == 77) GTEST_SKIP() << check.err;
  ASSERT_EQ(check.code, 0) << check.err;
  const std::vector<std::string> scenes = shipped_scenes();
  std::size_t renders = 0;
  for (const std::string& scene : scenes) {
    std::vector<const char*> samplings{"visible"};
    // Compiling for the second driver takes long: half vectors otherwise once for each BSDF, and
    // with another integrator.
    const bool one_of_each =
        scene.starts_with("materials/") || scene == "cbox/cbox_conductors_mis.xml";
    if (one_of_each && samples_half_vectors(load_scene(scene))) samplings.push_back("ndf");
    renders += samplings.size();
    for (const char* sampling : samplings) {
      SCOPED_TRACE(scene + " " + sampling);
      const std::vector<Image> images = render(scene, sampling, {{}, second});
      const std::string driver = metadata(images[0], "facet.driver");
      if (metadata(images[1], "facet.driver") == driver)
        GTEST_SKIP() << "both drivers are " << driver;
      expect_equal_bits(images[0], images[1]);
    }
  }
  EXPECT_GE(renders, scenes.size() + 6);
}

void expect_equal_bits(const Film& a, const Film& b) {
  ASSERT_FALSE(a.pixels.empty());
  EXPECT_TRUE(a.pixels == b.pixels);
}

/// Expects two renders of disjoint samples of a crop to sum to what the whole image holds there.
/// Sums of two floats keep 2^-44 of a few samples; a sample that differs in its last bit shows at
/// 2^-27.
void expect_sum(const Film& whole, const Film& a, const Film& b, const Crop& crop) {
  std::size_t i = 0;
  int different = 0;
  for (int y = crop.y0; y < crop.y1; ++y) {
    for (int x = crop.x0; x < crop.x1; ++x, ++i) {
      const PixelSums& all = whole.pixels[whole.index(x, y)];
      ASSERT_EQ(all.samples, a.pixels[i].samples + b.pixels[i].samples);
      ASSERT_EQ(all.nonzero, a.pixels[i].nonzero + b.pixels[i].nonzero);
      for (std::size_t c = 0; c < 3; ++c) {
        const double sum = all.values[c];
        const double parts = a.pixels[i].values[c] + b.pixels[i].values[c];
        different += std::abs(sum - parts) > std::ldexp(std::abs(sum), -44) ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(different, 0);
}

/// Renders shipped scenes through the library. With 6 samples, passes hold 1, 1, 2 and 2 of them;
/// 1000 paths in flight cut the image into ranges, 2500 cut the passes of two samples.
TEST(ReproduciblePasses, any_size_and_any_part_of_image_and_samples) {
  for (const std::string& name : shipped_scenes()) {
    SCOPED_TRACE(name);
    Scene scene = load_scene(name);
    scene.camera.width = width;
    scene.camera.height = height;
    const auto film = [&](const RenderSettings& settings) { return render(scene, settings).film; };

    RenderSettings in_ranges = whole_image(scene, 6);
    const Film whole = film(in_ranges);
    for (const std::uint32_t paths : {1000U, 2500U}) {
      in_ranges.paths_in_flight = paths;
      expect_equal_bits(whole, film(in_ranges));
    }

    RenderSettings part = whole_image(scene, 5);
    part.crop = {7, 11, 29, 24};
    RenderSettings rest = part;
    rest.samples = {5, 6};
    expect_sum(whole, film(part), film(rest), part.crop);
  }
}

}  // namespace
}  // namespace facet::test
