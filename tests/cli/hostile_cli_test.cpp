// Strangers' files: names that command terminals and pages, files that are none, nesting without
// end.
#include <sys/stat.h>

#include "cli/program.h"
#include "image/files.h"

namespace facet::test {
namespace {

class HostileCliTest : public CliTest {
 protected:
  /// Expects that a text of ours holds nothing that commands a terminal or a page.
  static void expect_harmless(const std::string& text, const std::string& what, bool is_page) {
    EXPECT_FALSE(text.empty()) << what;
    EXPECT_EQ(text.find('\x1b'), std::string::npos) << what;
    EXPECT_EQ(text.find("\nforged"), std::string::npos) << what;
    if (is_page) {
      EXPECT_EQ(text.find("<b>&"), std::string::npos) << what;
      EXPECT_EQ(text.find("<script>forged"), std::string::npos) << what;
    }
  }

  static constexpr const char* name = "<b>&\"'\x1b[31m\nforged<script>forged.xml";
  /// The same in a scene.
  static constexpr const char* spelled =
      "&lt;b&gt;&amp;&quot;'&#27;[31m&#10;forged&lt;/script&gt;forged";
};

TEST_F(HostileCliTest, NamesCommandNothing) {
  const std::string named = std::string(spelled) + ".obj";
  folder_.write("odd.obj", "mtllib odd.mtl\nusemtl \x1b[31m<b>&\n" + folder_.read("floor.obj"));
  folder_.write("odd.mtl", "newmtl \x1b[31m<b>&\nKd 2 0 0\nmap_Kd \x1b[31mnone.png\n");
  write_scene(name, floor() + light() +
                        "<mesh type=\"obj\"><string name=\"filename\" value=\"odd.obj\"/></mesh>");
  folder_.write("test.xml", "<test type=\"chi2test\"><bsdf type=\"diffuse\"/></test>");
  const std::string image = std::string(name) + ".exr";
  const std::string test = std::string(name) + ".test";
  std::filesystem::rename(folder_.file("test.xml"), folder_.file(test));
  const auto harmless = [&](const std::vector<std::string>& arguments) {
    const Result result = run(arguments);
    SCOPED_TRACE(::testing::PrintToString(arguments));
    EXPECT_NE(result.code, 3) << result.err;
    expect_harmless(result.out + result.err, "the terminal", false);
  };
  harmless({"render", name, "-o", image, "--json", "r.json"});
  harmless({"info", name});
  harmless({"info", image});
  harmless({"compare", image, image, "--html", "c.html", "--json", "c.json"});
  harmless({"parity", name, "--json", "p.json"});
  harmless({"tradeoff", name, "--budget", "1", "--html", "t.html", "--json", "t.json"});
  harmless({"bench", name, "--quick", "--html", "b.html", "--json", "b.json"});
  harmless({"test", test, "--junit", "j.xml", "--json", "j.json"});
  harmless({"merge", image, "-o", "m.exr"});
  harmless({"render", image});
  harmless({name});
  harmless({"render", name, name});
  harmless({"render", name, "--sampler", name});
  harmless({"render", name, "-o", std::string(name) + "/a.exr"});
  // A scene that holds the name.
  write_scene("holds.xml", mesh(named, std::string("<bsdf type=\"") + spelled + "\"/>"));
  harmless({"render", "holds.xml"});
  for (const char* page : {"c.html", "t.html", "b.html"})
    expect_harmless(folder_.read(page), page, true);
  expect_harmless(folder_.read("j.xml"), "j.xml", true);
  for (const char* report : {"r.json", "c.json", "p.json", "t.json", "b.json", "j.json"})
    expect_harmless(folder_.read(report), report, false);
}

TEST_F(HostileCliTest, WhatIsNoFileIsNotRead) {
  ASSERT_EQ(::mkfifo(folder_.file("pipe").c_str(), 0600), 0);
  std::filesystem::create_directory(folder_.file("folder"));
  folder_.write("empty", "");
  for (const char* file :
       {"pipe", "folder", "empty", "/dev/zero", "/dev/null", "/proc/self/maps"}) {
    for (const char* command : {"render", "info", "parity", "test", "tradeoff"})
      expect_failure({command, file}, 2, {file});
    expect_failure({"compare", file, file}, 2, {file});
    expect_failure({"merge", file, "-o", "a.exr"}, 2, {file});
    write_scene("mesh.xml", mesh(file, "<bsdf type=\"diffuse\"/>") + light());
    expect_failure({"info", "mesh.xml"}, 2, {"mesh.xml:5", file});
    write_scene("sky.xml", "<emitter type=\"environment\"><string name=\"filename\" value=\"" +
                               std::string(file) + "\"/></emitter>");
    expect_failure({"info", "sky.xml"}, 2, {"sky.xml:5", file});
    folder_.write("square.obj",
                  "mtllib " + std::string(file) + "\nusemtl m\n" + folder_.read("floor.obj"));
    write_scene("materials.xml",
                "<mesh type=\"obj\"><string name=\"filename\" value=\"square.obj\"/></mesh>");
    EXPECT_EQ(run({"info", "materials.xml"}).code, 0) << file;
  }
}

TEST_F(HostileCliTest, NestingMayBeDeep) {
  const auto nested = [](const std::string& tag) {
    constexpr int depth = 100'000;
    const std::string element = tag.substr(0, tag.find(' '));
    std::string text;
    for (int i = 0; i < depth; ++i) text += "<" + tag + ">";
    for (int i = 0; i < depth; ++i) text += "</" + element + ">";
    return text;
  };
  for (const char* tag : {"bsdf type=\"diffuse\"", "mesh type=\"obj\"", "emitter type=\"area\"",
                          "texture type=\"checker\"", "transform name=\"toWorld\"", "scene", "x"}) {
    write_scene("deep.xml", mesh("floor.obj", nested(tag)) + light());
    expect_failure({"info", "deep.xml"}, 2, {"deep.xml:5"});
    folder_.write("deep.test", "<test type=\"ttest\">\n" + nested(tag) + "</test>");
    expect_failure({"test", "deep.test"}, 2, {"deep.test:"});
  }
  folder_.write("open.xml", std::string(3'000'000, '<'));
  expect_failure({"info", "open.xml"}, 2, {"open.xml:1", "not well-formed"});
}

TEST_F(HostileCliTest, NumbersBeyondAllBounds) {
  expect_failure({"render", "scene.xml", "-o", "a.exr", "--spp", "99999999999999999999"}, 2,
                 {"--spp"});
  expect_failure({"render", "scene.xml", "-o", "a.exr", "--resolution", "1048576x1048576"}, 2,
                 {"1048576x1048576"});
  // All that is allowed at once, which no 64 bits could count in samples of channels.
  expect_failure({"render", "scene.xml", "-o", "a.exr", "--spp", "1073741824", "--resolution",
                  "16384x8192", "--limit-memory", "300M", "--backend", "reference"},
                 2, {"out of memory while making the film of 16384x8192 pixels"});
  folder_.write("floor.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 1000000000\n");
  expect_failure({"info", "scene.xml"}, 2, {"floor.obj:4", "1000000000"});
  folder_.write("floor.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n");
  expect_failure({"info", "scene.xml"}, 2, {"floor.obj:4"});
}

}  // namespace
}  // namespace facet::test
