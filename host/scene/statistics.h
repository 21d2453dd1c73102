#pragma once
// What a render counts and tells while it runs, whatever renders.
#include <array>
#include <cstdint>
#include <functional>
#include <string_view>

namespace facet {

/// What the device works on, pass by pass.
enum class Stage : std::size_t { first_bounce, later_bounces, film };
inline constexpr std::array<std::string_view, 3> stage_names{"first_bounce", "later_bounces", "film"};

struct RenderStatistics {
  std::uint64_t closest_rays = 0;
  std::uint64_t any_rays = 0;
  std::uint64_t samples = 0;              ///< finished, over all pixels
  std::uint64_t bad_samples = 0;          ///< dropped: NaN, infinite or negative
  std::uint64_t bound_hits = 0;           ///< traversals stopped by their bound
  double compile_seconds = 0;             ///< of the kernels, by us and by the driver
  std::uint64_t kernel_instructions = 0;  ///< of the compiled kernels, in SPIR-V
  double render_seconds = 0;
  std::array<double, stage_names.size()>
      stage_seconds{};  ///< where RenderSettings::time_stages asks for them
  std::uint64_t device_bytes = 0;
};

/// Called after each pass with the share of the work done; returns whether to go on.
using ProgressCallback = std::function<bool(double done, const RenderStatistics& statistics)>;

}  // namespace facet
