// per_sample SCENE.xml X Y COUNT: the first samples of one pixel, from the kernels and from the
// reference in float and in double. All three use the same random numbers, so that a sample differs
// by rounding alone.
#include <facet/facet.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc != 5) return std::fputs("usage: per_sample SCENE.xml X Y COUNT\n", stderr), 2;
  try {
    const auto scene = facet::load_scene(argv[1]);
    const facet::RenderRequest request{.pixel = {{std::atoi(argv[2]), std::atoi(argv[3])}}};
    const auto kernels = facet::open_backend();
    const auto single = facet::open_backend({.reference = facet::Precision::float_});
    const auto exact = facet::open_backend({.reference = facet::Precision::double_});
    const auto a = kernels->start(scene, request);
    const auto b = single->start(scene, request);
    const auto c = exact->start(scene, request);
    std::printf("sample  %s | %s | %s\n", kernels->name().c_str(), single->name().c_str(),
                exact->name().c_str());
    for (int i = 0; i < std::atoi(argv[4]); ++i) {
      const auto sample = static_cast<std::uint32_t>(i);
      std::printf("%6d", i);
      for (facet::Rendering* rendering : {a.get(), b.get(), c.get()}) {
        const facet::Radiance r = rendering->sample(sample)[0];
        std::printf("  %.9g %.9g %.9g", static_cast<double>(r[0]), static_cast<double>(r[1]),
                    static_cast<double>(r[2]));
      }
      std::printf("\n");
    }
  } catch (const facet::Error& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
}
