// render SCENE.xml IMAGE...: on the best Vulkan device, to .exr and .png files.
#include <facet/facet.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc < 3) return std::fputs("usage: render SCENE.xml IMAGE...\n", stderr), 2;
  try {
    const auto scene = facet::load_scene(argv[1]);
    const auto film = facet::open_backend()->render(scene);
    for (int i = 2; i < argc; ++i) facet::write_image(argv[i], film);
  } catch (const facet::Error& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
}
