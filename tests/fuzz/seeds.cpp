#include "fuzz/seeds.h"

#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "image/files.h"
#include "parts/checkpoint.h"
#include "parts/part.h"
#include "support/states.h"

namespace facet::fuzz {

namespace {

constexpr const char* square =
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\n"
    "usemtl red\nf 1/1/1 2/2/1 3/1/1\nf -4 -2 -1\nf 1 2 3 4\n";
constexpr const char* materials =
    "newmtl red\nKd 0.8 0.1 0.1\nmap_Kd map.png\nnewmtl blue\nKd 0 0 1\n";

/// A scene in which something of every kind stands.
std::string make_scene(const std::string& bsdf, const std::string& more) {
  return R"(<?xml version="1.0"?>
<scene>
  <integrator type="path_mis"><integer name="maxDepth" value="4"/></integrator>
  <sampler type="independent"><integer name="sampleCount" value="4"/></sampler>
  <camera type="perspective">
    <float name="fov" value="40"/>
    <integer name="width" value="8"/><integer name="height" value="6"/>
    <transform name="toWorld">
      <scale value="1,1,1"/><rotate axis="0,1,0" angle="5"/><translate value="0,0,1"/>
      <lookat origin="0,0,4" target="0,0,0" up="0,1,0"/>
    </transform>
    <rfilter type="mitchell"/>
  </camera>
  <mesh type="obj"><string name="filename" value="square.obj"/>)" +
         bsdf + R"(<emitter type="area"><color name="radiance" value="1,2,3"/></emitter></mesh>
)" + more +
         "</scene>\n";
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// What a writer makes of it.
template <typename Write>
std::string written(const std::string& name, const Write& write) {
  const auto file =
      std::filesystem::temp_directory_path() / ("facet-seed-" + std::to_string(::getpid()) + name);
  write(file);
  std::string bytes = bytes_of(file);
  std::filesystem::remove(file);
  return bytes;
}

Image make_picture(const std::vector<std::string>& channels) {
  Image image(3, 2, channels);
  for (int i = 0; i < 6 * static_cast<int>(channels.size()); ++i)
    image.plane(0)[i] = static_cast<float>(i % 7) / 3;
  return image;
}

RenderState make_state() {
  RenderState state = test::make_state(2, 2, {0, 0, 2, 2}, 4);
  state.plan.done = 4;
  state.most = 16;
  state.image = std::vector<WordPlane>(16, WordPlane(4, 1));
  return state;
}

void add_scenes(std::vector<Seed>& list) {
  const std::array bsdfs{
      "<bsdf type=\"diffuse\"><texture type=\"checkerboard\" name=\"albedo\"/></bsdf>",
      "<bsdf type=\"roughconductor\"><float name=\"alpha\" value=\"0.1\"/><string "
      "name=\"material\" value=\"Cu\"/></bsdf>",
      "<bsdf type=\"roughsubstrate\"><color name=\"kd\" value=\"0.5\"/></bsdf>",
      "<bsdf type=\"dielectric\"><float name=\"intIOR\" value=\"1.5\"/></bsdf>",
      "<bsdf type=\"diffuse\"><texture type=\"textmap\" name=\"albedo\"><string "
      "name=\"filename\" value=\"map.png\"/></texture></bsdf>"};
  const std::string lights =
      "<emitter type=\"point\"><vector name=\"position\" value=\"0,1,2\"/></emitter>"
      "<emitter type=\"environment\"><string name=\"filename\" value=\"sky.exr\"/></emitter>";
  int number = 0;
  for (const char* bsdf : bsdfs) {
    const std::string name = "scene" + std::to_string(number++) + ".xml";
    list.push_back({"scene", name, make_scene(bsdf, lights)});
    list.push_back({"load", name, make_scene(bsdf, lights) + std::string(1, '\0') + square});
  }
  list.push_back({"test", "chi2.xml",
                  "<test type=\"chi2test\"><integer name=\"resolution\" value=\"10\"/><bsdf "
                  "type=\"diffuse\"/><bsdf type=\"microfacet\"><float name=\"alpha\" "
                  "value=\"0.2\"/></bsdf></test>"});
  list.push_back({"test", "ttest.xml",
                  "<test type=\"ttest\"><string name=\"angles\" value=\"0, 30\"/><string "
                  "name=\"references\" value=\"0.5, 0.5\"/><bsdf type=\"diffuse\"/></test>"});
}

}  // namespace

std::vector<Seed> seeds() {
  std::vector<Seed> list;
  const Image picture = make_picture({"R", "G", "B"});
  const std::string png = written(".png", [&](const auto& f) { write_png(f, picture, 0); });
  const std::string exr = written(".exr", [&](const auto& f) { write_exr(f, picture); });
  list.push_back({"obj", "square.obj", square, true});
  list.push_back({"mtl", "m.mtl", materials, true});
  list.push_back({"image", "map.png", png, true});
  list.push_back({"image", "sky.exr", exr, true});
  list.push_back(
      {"image", "layers.exr", written(".exr", [](const auto& f) {
         write_exr(f, make_picture({"R", "G", "B", "A", "n.X"}), ExrCompression::uncompressed);
       })});
  std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 3\n";
  for (int i = 0; i < 6; ++i) hdr += std::string("\x40\x50\x60\x80", 4);
  list.push_back({"image", "sky.hdr", hdr});
  // The start of a JPEG: libjpeg's own tests go further.
  list.push_back(
      {"image", "start.jpg", std::string("\xFF\xD8\xFF\xE0\0\x10JFIF\0\1\1\0\0\1\0\1\0\0", 20)});
  const RenderState state = make_state();
  list.push_back({"part", "part.exr", written(".exr", [&](const auto& f) {
                    write_exr(f, make_part(state.film, true));
                  })});
  list.push_back({"part", "checkpoint.exr", written(".exr", [&](const auto& f) {
                    write_exr(f, make_checkpoint(state), ExrCompression::uncompressed);
                  })});
  add_scenes(list);
  return list;
}

}  // namespace facet::fuzz
