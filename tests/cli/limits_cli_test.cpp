// What services need that render strangers' scenes: files of one folder only, bounded memory and
// time.
#include "cli/program.h"
#include "core/sanitized.h"
#include "image/files.h"

namespace facet::test {
namespace {

class LimitsCliTest : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    std::filesystem::create_directory(folder_.file("in"));
    for (const char* name : {"floor.obj", "light.obj"})
      std::filesystem::copy(folder_.file(name), folder_.file(std::string("in/") + name));
    write_png(folder_.file("map.png"), Image(1, 1, {"R", "G", "B"}), 0);
    write_exr(folder_.file("sky.exr"), Image(1, 1, {"R", "G", "B"}));
    folder_.write("away.mtl", "newmtl m\nmap_Kd map.png\n");
  }

  /// Renders what is in the folder "in", which must be refused at line 5.
  void expect_refused(const std::string& content) const {
    write_scene("in/scene.xml", content);
    expect_failure({"render", "in/scene.xml", "-o", "a.exr", "--assets-below", "in"}, 2,
                   {"in/scene.xml:5: ", "is not read, as it is not below "});
    EXPECT_EQ(run({"render", "in/scene.xml", "-o", "a.exr"}).code, 0) << content;
    std::filesystem::remove(folder_.file("a.exr"));
  }

  static std::string textured(const std::string& map) {
    return mesh("floor.obj",
                "<bsdf type=\"diffuse\"><texture type=\"textmap\" name=\"albedo\"><string "
                "name=\"filename\" value=\"" +
                    map + "\"/></texture></bsdf>") +
           light();
  }
};

TEST_F(LimitsCliTest, NoFileOfOtherFoldersIsRead) {
  expect_refused(mesh("../floor.obj", "<bsdf type=\"diffuse\"/>") + light());
  expect_refused(mesh(folder_.file("floor.obj").string(), "<bsdf type=\"diffuse\"/>") + light());
  expect_refused(textured("../map.png"));
  expect_refused(
      "<emitter type=\"environment\"><string name=\"filename\" value=\"../sky.exr\"/></emitter>");
  // Whether there is such a file is not told either.
  write_scene("in/scene.xml", mesh("../none.obj", "") + light());
  expect_failure({"render", "in/scene.xml", "-o", "a.exr", "--assets-below", "in"}, 2,
                 {"in/scene.xml:5: ", "is not read"});
}

TEST_F(LimitsCliTest, LinksLeadNowhereElse) {
  std::filesystem::create_symlink(folder_.file("floor.obj"), folder_.file("in/link.obj"));
  std::filesystem::create_directory_symlink(folder_.path(), folder_.file("in/up"));
  std::filesystem::create_symlink("link.obj", folder_.file("in/second.obj"));
  for (const char* name : {"link.obj", "up/floor.obj", "second.obj"})
    expect_refused(mesh(name, "<bsdf type=\"diffuse\"/>") + light());
  // Links within the folder, and a folder that is named by one.
  std::filesystem::create_symlink("floor.obj", folder_.file("in/inner.obj"));
  std::filesystem::create_directory_symlink("in", folder_.file("alias"));
  write_scene("in/scene.xml", mesh("inner.obj", "<bsdf type=\"diffuse\"/>") + light());
  for (const char* below : {"in", "alias", "in/../alias", "."}) {
    const Result result =
        run({"render", "in/scene.xml", "-o", "a.exr", "--assets-below", below, "--quiet"});
    EXPECT_EQ(result.code, 0) << below << ": " << result.err;
  }
}

TEST_F(LimitsCliTest, MaterialsAndTheirMapsAreAssetsToo) {
  const std::string square = folder_.read("floor.obj");
  const std::string self =
      "<mesh type=\"obj\"><string name=\"filename\" value=\"named.obj\"/></mesh>";
  folder_.write("in/named.obj", "mtllib ../away.mtl\nusemtl m\n" + square);
  expect_refused(self + light());
  folder_.write("in/own.mtl", "newmtl m\nmap_Kd ../map.png\n");
  folder_.write("in/named.obj", "mtllib own.mtl\nusemtl m\n" + square);
  expect_refused(self + light());
}

TEST_F(LimitsCliTest, TheSceneAndTestsAreHeldToItAsWell) {
  expect_failure({"render", "scene.xml", "-o", "a.exr", "--assets-below", "in"}, 2,
                 {"scene.xml: is not read"});
  expect_failure({"info", "scene.xml", "--assets-below", "in"}, 2, {"scene.xml: is not read"});
  expect_failure({"parity", "scene.xml", "--assets-below", "in"}, 2, {"scene.xml: is not read"});
  expect_failure({"tradeoff", "scene.xml", "--assets-below", "in"}, 2, {"scene.xml: is not read"});
  expect_failure({"bench", "scene.xml", "--assets-below", "in"}, 2, {"scene.xml: is not read"});
  folder_.write("test.xml", "<test type=\"chi2test\"><bsdf type=\"diffuse\"/></test>");
  expect_failure({"test", "test.xml", "--assets-below", "in"}, 2, {"test.xml: is not read"});
  expect_failure({"render", "scene.xml", "-o", "a.exr", "--assets-below", "none"}, 2,
                 {"none: no folder"});
  expect_failure({"render", "scene.xml", "-o", "a.exr", "--assets-below", ""}, 2,
                 {"--assets-below", "an empty path"});
  expect_failure({"render", "scene.xml", "-o", "a.exr", "--assets-below", "scene.xml"}, 2,
                 {"scene.xml: no folder"});
}

TEST_F(LimitsCliTest, WhatLacksMemoryIsNamed) {
  if (is_sanitized) GTEST_SKIP() << "AddressSanitizer takes memory as it likes";
  const std::vector<std::string> large{"--resolution", "16384x8192", "--backend", "reference",
                                       "--limit-memory"};
  for (const char* limit : {"100M", "0.1 GB", "100000000"}) {
    std::vector<std::string> words{"render", "scene.xml", "-o", "a.exr"};
    words.insert(words.end(), large.begin(), large.end());
    words.emplace_back(limit);
    expect_failure(words, 2,
                   {"out of memory while making the film of 16384x8192 pixels: ",
                    "GB more would be needed, ", "MB are left; about ", "pixels fit"});
  }
  expect_failure({"render", "scene.xml", "-o", "a.exr", "--resolution", "16384x16384"}, 2,
                 {"the film of 268435456 pixels needs ", "of device memory", "pixels fit"});
  for (const char* wrong : {"x", "-1G", "0", "1k", "1e30G", ""})
    expect_failure({"render", "scene.xml", "-o", "a.exr", "--limit-memory", wrong}, 2,
                   {"--limit-memory"});
  EXPECT_FALSE(std::filesystem::exists(folder_.file("a.exr")));
  EXPECT_EQ(run({"render", "scene.xml", "-o", "a.exr", "--limit-memory", "4G"}).code, 0);
}

TEST_F(LimitsCliTest, AMeshThatLacksMemoryIsNamed) {
  if (is_sanitized) GTEST_SKIP() << "AddressSanitizer takes memory as it likes";
  std::string text;
  for (int i = 0; i < 200000; ++i) text += "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -3\n";
  folder_.write("floor.obj", text);
  expect_failure({"info", "scene.xml", "--limit-memory", "30M"}, 2,
                 {"out of memory while reading the mesh floor.obj: "});
}

TEST_F(LimitsCliTest, WhatTakesTooLongEnds) {
  folder_.write("a.exr", "what was there");
  expect_failure({"render", "scene.xml", "-o", "a.exr", "--spp", "100000000", "--quiet",
                  "--limit-time", "1.5"},
                 2, {"--limit-time 1.5: the time is over", "what was not written by now is not"});
  EXPECT_EQ(folder_.read("a.exr"), "what was there");
  for (const std::string& name : folder_.names()) EXPECT_FALSE(name.starts_with(".facet")) << name;
  EXPECT_EQ(run({"render", "scene.xml", "-o", "a.exr", "--limit-time", "3600"}).code, 0);
}

}  // namespace
}  // namespace facet::test
