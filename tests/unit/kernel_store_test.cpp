// Compiled kernels that are kept: who shares them, and that images do not change.
#include "render/kernel_store.h"

#include <gtest/gtest.h>

#include "support/render.h"
#include "support/scenes.h"

namespace facet::test {

namespace {

Scene lit_floor() {
  Scene scene = make_scene("path_mis");
  set_camera(scene, 8, 40, {0, 2, -3}, {0, 0, 0});
  add_mesh(scene, make_quad({-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}), bsdf::Diffuse{});
  add_mesh(scene, make_quad({-1, 3, -1}, {1, 3, -1}, {1, 3, 1}, {-1, 3, 1}), bsdf::Diffuse{},
           Color(1));
  return scene;
}

Features features_of(const Scene& scene, int max_depth) {
  RenderSettings settings = whole_image(scene, 1);
  settings.integrator.max_depth = max_depth;
  return pack_scene(scene, settings).features;
}

TEST(KernelStore, EqualFeaturesShareTheirKernels) {
  const Scene scene = lit_floor();
  KernelStore store;
  const auto find = [&](GeometryFetch fetch, const Features& features, std::uint32_t stack) {
    return store.find_or_make(device(), fetch, features, stack);
  };
  constexpr GeometryFetch fetch = GeometryFetch::storage_buffer;
  const Features features = features_of(scene, 3);
  const auto first = find(fetch, features, 16);
  EXPECT_EQ(find(fetch, features, 16), first);
  EXPECT_NE(find(fetch, features, 24), first);
  EXPECT_NE(find(GeometryFetch::texel_buffer, features, 16), first);
  Features others = features;
  others.sampler = Sampler::sobol;
  EXPECT_NE(find(fetch, others, 16), first);
  // Which kernels there are depends on the depth, although none is specialised to it.
  EXPECT_NE(find(fetch, features_of(scene, 2), 16), first);
  EXPECT_EQ(find(fetch, features, 16), first);
}

TEST(KernelStore, ForgetsWhatHasNotBeenAskedForTheLongest) {
  const Scene scene = lit_floor();
  KernelStore store;
  const Features features = features_of(scene, 3);
  const auto find = [&](std::uint32_t stack) {
    return store.find_or_make(device(), GeometryFetch::storage_buffer, features, stack);
  };
  const auto kept = find(1);
  const std::weak_ptr<RenderProgram> dropped = find(2);
  for (std::uint32_t stack = 3; stack < 100; ++stack) {
    (void)find(stack);
    EXPECT_EQ(find(1), kept);
  }
  EXPECT_TRUE(dropped.expired());
}

/// Where emitters alone are sampled, depths 0 and 1 both end after one bounce, the first of them
/// without light from elsewhere.
TEST(KernelStore, KernelsOfOneDepthAreNotThoseOfAnother) {
  KernelStore store;
  for (const char* integrator : {"path_ems", "path_mis", "direct_ems", "whitted"}) {
    for (const int depth : {0, 1, 2}) {
      Scene scene = lit_floor();
      set_integrator(scene, integrator);
      scene.integrator.max_depth = depth;
      const PackedScene packed = pack_scene(scene, whole_image(scene, 4));
      Renderer with_store(device(), packed, store);
      Renderer alone(device(), packed);
      with_store.render({});
      alone.render({});
      EXPECT_TRUE(with_store.film().pixels == alone.film().pixels) << integrator << ' ' << depth;
    }
  }
}

TEST(KernelStore, ASecondRenderIsTheFirstAgain) {
  const auto scene = std::make_shared<const Scene>(lit_floor());
  KernelBackend& backend = kernel_backend();
  const RenderRequest request{.samples = 4, .seed = 5};
  const Film first = backend.render(scene, request);
  // Another one in between, with the same kernels and other buffers.
  EXPECT_NE(backend.render(scene, {.samples = 4, .size = {{6, 6}}, .seed = 6}).pixels,
            first.pixels);
  EXPECT_EQ(backend.render(scene, request).pixels, first.pixels);
  // Two at a time.
  const auto a = backend.start(scene, request);
  const auto b = backend.start(scene, request);
  a->run({});
  b->run({});
  EXPECT_EQ(a->film().pixels, first.pixels);
  EXPECT_EQ(b->film().pixels, first.pixels);
  expect_silent_validation();
}

}  // namespace

}  // namespace facet::test
