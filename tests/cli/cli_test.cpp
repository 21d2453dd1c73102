// Usage, messages and exit codes of the program.
#include "cli/program.h"
#include "image/files.h"

namespace facet::test {

namespace {

using Names = std::vector<std::string>;

TEST_F(CliTest, Version) {
  const Result result = run({"--version"});
  EXPECT_EQ(result.code, 0);
  expect_words(result.out, {"facet ", "Vulkan 1."});
  EXPECT_EQ(result.err, "");
}

TEST_F(CliTest, Help) {
  const Result result = run({"--help"});
  EXPECT_EQ(result.code, 0);
  expect_words(result.out,
               {"render", "info", "compare", "merge", "parity", "devices", "--version"});
  const Result render = run({"render", "--help"});
  EXPECT_EQ(render.code, 0);
  expect_words(render.out,
               {"--spp", "--integrator", "--sampler", "--max-depth", "--resolution", "--crop",
                "--seed", "--sample-range", "--pixel", "--device", "--sampling", "--aov",
                "--exposure", "--json", "--quiet", "--strict", "--validate"});
}

TEST_F(CliTest, UnknownCommandsAndOptions) {
  expect_failure({}, 2, {"facet: ", "--help"});
  expect_failure({"rendr", "scene.xml"}, 2,
                 {"unknown command \"rendr\"", "did you mean \"render\"?"});
  expect_failure({"render"}, 2, {"scene", "required"});
  expect_failure({"render", "scene.xml", "--sppp", "4"}, 2, {"--sppp"});
  expect_failure({"--verbose"}, 2, {"--verbose"});
  expect_failure({"render", "scene.xml", "other.xml"}, 2, {"other.xml"});
}

TEST_F(CliTest, OptionValues) {
  for (const char* spp : {"0", "-1", "many", "1.5", "99999999999"})
    expect_failure({"render", "scene.xml", "--spp", spp}, 2, {"--spp"});
  expect_failure({"render", "scene.xml", "--seed", "-1"}, 2, {"--seed"});
  expect_failure({"render", "scene.xml", "--max-depth", "-2"}, 2, {"--max-depth"});
  expect_failure({"render", "scene.xml", "--sampling", "all"}, 2, {"--sampling", "visible"});
  expect_failure({"render", "scene.xml", "--aov", "albdo"}, 2, {"--aov", "variance"});
  expect_failure({"render", "scene.xml", "--integrator", "path_miss"}, 2,
                 {"path_miss", "did you mean \"path_mis\"?"});
  expect_failure({"render", "scene.xml", "--sampler", "sobl"}, 2,
                 {"sampler", "did you mean \"sobol\"?", "independent"});
  expect_failure({"render", "scene.xml", "--device", "no such device"}, 3,
                 {"no such device", "facet devices"});
  expect_failure({"render", "scene.xml", "--device", "99"}, 3, {"99", "facet devices"});
}

TEST_F(CliTest, Regions) {
  for (const char* crop : {"0,0,17,16", "4,4,4,8", "8,8,4,4", "16,0,17,1"})
    expect_failure({"render", "scene.xml", "--crop", crop}, 2, {"crop", crop, "16x16"});
  for (const char* crop : {"", "1,2,3", "0,0,1,1,1", "a,b,c,d", "0,0,1,1x", "0 0 1 1", ",,,",
                           "0,0,1,99999999999999999999"})
    expect_failure({"render", "scene.xml", "--crop", crop}, 2, {"--crop", "X0,Y0,X1,Y1"});
  expect_failure({"render", "scene.xml", "--crop=-1,0,4,4"}, 2, {"--crop", "X0,Y0,X1,Y1"});
  for (const char* pixel : {"16,0", "0,16"})
    expect_failure({"render", "scene.xml", "--pixel", pixel}, 2, {"pixel", pixel, "16x16"});
  expect_failure({"render", "scene.xml", "--pixel", "4294967296,0"}, 2,
                 {"--pixel", "4294967296", "too large"});
  expect_failure({"render", "scene.xml", "--pixel", "3"}, 2, {"--pixel", "X,Y"});
  expect_failure({"render", "scene.xml", "--pixel", "9223372036854775807,0"}, 2, {"--pixel"});
  expect_failure({"render", "scene.xml", "--pixel", "1,1", "--crop", "0,0,2,2"}, 2,
                 {"crop", "pixel", "exclude"});
}

TEST_F(CliTest, Sizes) {
  for (const char* size : {"0x0", "0x16", "100000x100000", "1x2000000"})
    expect_failure({"render", "scene.xml", "--resolution", size}, 2, {size, "pixels"});
  for (const char* size : {"16", "16X16", "16x", "axb", "16x16x3", "-4x4"})
    expect_failure({"render", "scene.xml", std::string("--resolution=") + size}, 2,
                   {"--resolution", size, "WxH"});
}

TEST_F(CliTest, SampleRanges) {
  for (const char* range : {"0:0", "4:2", "0:1999999999"})
    expect_failure({"render", "scene.xml", "--sample-range", range}, 2, {"sample range", range});
  expect_failure({"render", "scene.xml", "--sample-range", "0:99999999999"}, 2,
                 {"--sample-range", "0:99999999999", "too large"});
  for (const char* range : {"4", "a:b", "1:2:3", ":"})
    expect_failure({"render", "scene.xml", "--sample-range", range}, 2,
                   {"--sample-range", range, "A:B"});
}

TEST_F(CliTest, FilesThatCannotBeRead) {
  expect_failure({"render", "none.xml"}, 2, {"none.xml", "no such file"});
  expect_failure({"info", "none.xml"}, 2, {"none.xml", "no such file"});
  folder_.write("bad.xml", "<scene>\n<camera type=\"perspective\">\n");
  expect_failure({"render", "bad.xml"}, 2, {"bad.xml:", "not well-formed XML"});
  write_scene("unknown.xml", mesh("floor.obj", "\n<bsdf type=\"difuse\"/>"));
  expect_failure({"render", "unknown.xml"}, 2,
                 {"unknown.xml:6: ", "difuse", "did you mean \"diffuse\"?"});
  write_scene("mesh.xml", "\n" + mesh("none.obj", ""));
  expect_failure({"render", "mesh.xml"}, 2, {"mesh.xml:6: ", "none.obj"});
  folder_.write("damaged.exr", "not an image");
  write_scene(
      "sky.xml",
      "<emitter type=\"environment\"><string name=\"filename\" value=\"damaged.exr\"/></emitter>");
  expect_failure({"render", "sky.xml"}, 2, {"sky.xml:5: ", "damaged.exr", "EXR"});
  EXPECT_FALSE(std::filesystem::exists(folder_.file("sky.exr")));
}

TEST_F(CliTest, FilesThatCannotBeWritten) {
  std::filesystem::create_directory(folder_.file("folder.exr"));
  expect_failure({"render", "scene.xml", "-o", "folder.exr"}, 2, {"folder.exr", "cannot write"});
  expect_failure({"render", "scene.xml", "-o", "none/a.exr"}, 2, {"none/a.exr", "no such folder"});
  expect_failure({"render", "scene.xml", "-o", "a.exr", "--json", "none/a.json"}, 2,
                 {"none/a.json", "no such folder"});
  expect_failure({"render", "scene.xml", "-o", "a.exr", "-o", "./a.exr"}, 2, {"./a.exr", "twice"});
  for (const char* exposure : {"nan", "101", "bright"})
    expect_failure({"render", "scene.xml", "-o", "a.png", "--exposure", exposure}, 2,
                   {"--exposure"});
  for (const char* name : {"a.jpg", "a", ".exr", "a.exr.gz"})
    expect_failure({"render", "scene.xml", "-o", name}, 2, {name, ".exr or .png"});
  EXPECT_EQ(folder_.names(), (Names{"floor.obj", "folder.exr", "light.obj", "scene.xml"}));
}

TEST_F(CliTest, AnOldImageSurvivesAFailedRender) {
  folder_.write("old.exr", "old");
  write_scene("bad.xml", mesh("none.obj", ""));
  expect_failure({"render", "bad.xml", "-o", "old.exr"}, 2, {"none.obj"});
  EXPECT_EQ(folder_.read("old.exr"), "old");
  const Result result = run({"render", "scene.xml", "-o", "old.exr", "--device", "none"});
  EXPECT_EQ(result.code, 3);
  EXPECT_EQ(folder_.read("old.exr"), "old");
}

TEST_F(CliTest, WarningsAndStrictness) {
  write_scene(
      "unknown.xml",
      light() + mesh("floor.obj",
                     "\n<bsdf type=\"diffuse\"><color name=\"albeod\" value=\"1\"/></bsdf>"));
  const Result result = run({"render", "unknown.xml", "-o", "a.exr", "--quiet"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err.rfind("warning: unknown.xml:7: ", 0), 0U) << result.err;
  expect_words(result.err, {"\"albeod\"", "ignored", "did you mean \"albedo\"?"});
  expect_failure({"render", "unknown.xml", "-o", "b.exr", "--strict"}, 2,
                 {"unknown.xml:7: ", "\"albeod\"", "--strict"});
  expect_failure({"info", "unknown.xml", "--strict"}, 2,
                 {"unknown.xml:7: ", "\"albeod\"", "--strict"});
  EXPECT_FALSE(std::filesystem::exists(folder_.file("b.exr")));
}

TEST_F(CliTest, NoIntegrator) {
  folder_.write("plain.xml", "<scene><camera type=\"perspective\"/></scene>");
  expect_failure({"render", "plain.xml"}, 2, {"plain.xml", "no integrator", "--integrator"});
}

TEST_F(CliTest, WithoutAVulkanDriver) {
  const Names variables{"VK_ICD_FILENAMES=/nonexistent.json", "VK_DRIVER_FILES=/nonexistent.json"};
  for (const Names& arguments : {Names{"render", "scene.xml", "-o", "a.exr"}, Names{"devices"}}) {
    const Result result = run(arguments, variables);
    EXPECT_EQ(result.code, 3) << result.err;
    expect_words(result.err, {"facet: ", "mesa-vulkan-drivers"});
    EXPECT_EQ(result.err.find("nonexistent"), std::string::npos)
        << "the loader's own words: " << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.file("a.exr")));
}

TEST_F(CliTest, ReadingNeedsNoDriver) {
  const Names variables{"VK_ICD_FILENAMES=/nonexistent.json", "VK_DRIVER_FILES=/nonexistent.json"};
  EXPECT_EQ(run({"info", "scene.xml"}, variables).code, 0);
}

TEST_F(CliTest, Devices) {
  const Result result = run({"devices"});
  EXPECT_EQ(result.code, 0);
  expect_words(result.out, {"0: ", "Vulkan 1.", "facet needs: ", "used: "});
  EXPECT_EQ(result.err, "");
}

TEST_F(CliTest, DevicesSayWhereCompiledKernelsAreKept) {
  const std::string folder = folder_.file("cache");
  expect_words(run({"devices"}, {"MESA_SHADER_CACHE_DIR=" + folder}).out,
               {"compiled kernels", folder.c_str()});
  expect_words(run({"devices"}, {"MESA_SHADER_CACHE_DISABLE=true"}).out,
               {"keeps no compiled kernels"});
}

TEST_F(CliTest, Info) {
  const Result result = run({"info", "scene.xml"});
  EXPECT_EQ(result.code, 0);
  expect_words(result.out, {"16 x 16 pixels", "4 samples (independent)", "direct_mis",
                            "meshes: 2, triangles: 4", "bsdfs: 2, textures: 0, emitters: 1",
                            "floor.obj", "light.obj", "BVH", "device memory", "compiled for it"});
  EXPECT_EQ(result.err, "");
  expect_failure({"info"}, 2, {"scene file", "--supported"});
}

TEST_F(CliTest, InfoListsWhatIsSupported) {
  const Result list = run({"info", "--plugins"});
  EXPECT_EQ(list.code, 0);
  expect_words(list.out, {"bsdf        diffuse: ", "sampler     independent, sobol, zsobol: ",
                          "direct_ems, direct_mats"});
  const Result manual = run({"info", "--plugins", "whitted"});
  EXPECT_EQ(manual.code, 0);
  expect_words(manual.out, {"integrator \"whitted\": ", "maxDepth"});
  expect_failure({"info", "--plugins", "difuse"}, 2, {"\"difuse\"", "did you mean \"diffuse\"?"});
  const Result result = run({"info", "--supported"});
  EXPECT_EQ(result.code, 0);
  expect_words(result.out, {"supported:", "diffuse", "roughconductor", "direct_mis", "gaussian",
                            "environment"});
}

}  // namespace

}  // namespace facet::test
