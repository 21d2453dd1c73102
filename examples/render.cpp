// render SCENE.xml OUT.exr: 64 samples a pixel on the best Vulkan device.
#include <facet/facet.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) return std::fputs("usage: render SCENE.xml OUT.exr\n", stderr), 2;
  try {
    const auto scene = facet::load_scene(argv[1]);
    const auto backend = facet::open_backend();
    facet::write_image(argv[2], backend->render(scene, {.samples = 64}));
  } catch (const facet::Error& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
}
