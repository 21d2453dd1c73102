#pragma once
// How fast whole scenes render, and what goes before.
#include <array>
#include <string>
#include <vector>

#include "core/figure.h"
#include "gpu/device.h"
#include "render/stages.h"
#include "scene/scene.h"

namespace facet::bench {

struct RenderRow {
  std::string scene;
  std::string integrator;
  std::uint32_t samples_per_pixel = 0;
  Figure samples_per_second;
  double rays_per_second = 0;  ///< of the median run
  double compile_seconds = 0;  ///< of kernels, by us and by the driver, in the first run
  double startup_seconds = 0;  ///< packing, uploading and compiling, in the first run
  std::uint64_t device_bytes = 0;
  std::uint64_t kernel_instructions = 0;  ///< of all kernels, in SPIR-V
  StageSeconds stage_shares{};            ///< of the device's time; all 0 without timestamps
};

struct WholeRenderOptions {
  std::uint32_t samples_per_pixel = 64;
  int repeats = 3;
  bool with_everything = false;  ///< also with kernels from which nothing is left out
};

/// Renders the scene `repeats` times at its own size, with kernels made for it, and in turn with
/// those that have everything in if that is wanted: a row each. Throws InputError where it does not
/// fit the device.
[[nodiscard]] std::vector<RenderRow> measure_render(gpu::Device& device, const std::string& name,
                                                    const Scene& scene,
                                                    const WholeRenderOptions& options);

}  // namespace facet::bench
