#pragma once
// What a caller asks of a render beyond what the scene says.
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace facet {

/// Pixels [x0, x1) x [y0, y1) of the image; (0, 0) is the upper left corner.
struct Crop {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;

  [[nodiscard]] bool operator==(const Crop&) const = default;
};

/// Samples [begin, end) of every pixel.
struct SampleRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  [[nodiscard]] bool operator==(const SampleRange&) const = default;
};

/// One of so many shares that are as equal as whole samples or rows allow; counted from 1. The
/// share i of n of [a, b) is [a + (b - a) (i - 1) / n, a + (b - a) i / n), rounded down.
struct Share {
  std::uint32_t index = 1;
  std::uint32_t count = 1;
};

/// Width and height of an image in pixels.
struct ImageSize {
  int width = 0;
  int height = 0;
};

/// How the two estimates of direct light are weighted (E. Veach, "Robust Monte Carlo Methods for
/// Light Transport Simulation", 1997, 9.2).
enum class Heuristic { balance, power };

/// How the emitter of a light sample is chosen: each as often; by power; or it and its triangle by
/// what they can contribute to the shaded point, through a light tree.
enum class EmitterSelection { uniform, power, contribution };

/// How points of area emitters are sampled: by area, or by the solid angle that a triangle (or a
/// quadrilateral of two) fills as seen from the shaded point (J. Arvo, "Stratified Sampling of
/// Spherical Triangles", SIGGRAPH 1995).
enum class AreaSampling { area, solid_angle };

/// How directions towards an environment are sampled: by its radiance; or, where BSDFs are sampled
/// as well, by what of its radiance exceeds the mean, since the BSDFs' samples find the rest (I.
/// Karlík, M. Šik, P. Vévoda, T. Skřivan, J. Křivánek, "MIS Compensation: Optimizing Sampling
/// Techniques in Multiple Importance Sampling", ACM TOG 38(6), 2019).
enum class EnvironmentSampling { radiance, compensated };

/// Smith's masking function of Beckmann's distribution: its exact form, or the rational
/// approximation of B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces",
/// EGSR 2007.
enum class Masking : std::uint8_t { rational, exact };

/// How directions are sampled: half vectors of rough lobes from the distribution of normals or from
/// the normals that the viewer sees; or, by the reference alone, every BSDF by the uniform
/// hemisphere (of what transmits, the sphere), which needs none of the BSDFs' sampling code.
enum class LobeSampling { ndf, visible, uniform };

/// What a render has counted so far.
struct RenderStatistics {
  std::uint64_t closest_rays = 0;  ///< rays that looked for their nearest hit
  std::uint64_t any_rays = 0;      ///< rays that looked for any hit: shadow rays
  std::uint64_t samples = 0;       ///< finished, over all pixels
  std::uint64_t planned = 0;       ///< samples that there will be in the end, as far as is known
  std::uint64_t bad_samples = 0;   ///< dropped: NaN, infinite or negative
  std::uint64_t bound_hits =
      0;                   ///< traversals stopped by their safety bound; the image is wrong there
  double bvh_seconds = 0;  ///< of building the kernels' BVH
  double compile_seconds = 0;  ///< of the kernels, by facet and by the driver
  double render_seconds = 0;
  std::uint64_t kernel_instructions = 0;  ///< of the compiled kernels, in SPIR-V
  std::uint64_t device_bytes = 0;         ///< memory on the device
  std::vector<std::string> features;      ///< what the kernels were compiled for, in words
};

/// Fewest samples a pixel that a render can be adaptive with.
inline constexpr std::uint32_t least_adaptive_samples = 16;

/// Called after each pass with the share of the work that is done, from 0 to 1; returns whether to
/// go on.
using ProgressCallback = std::function<bool(double done, const RenderStatistics& statistics)>;

/// Wishes of a caller. What is not set follows the scene.
struct RenderRequest {
  /// Of each pixel, which is also what the sampler zsobol orders them for; with `error` or
  /// `deadline` the most there may be, and as many as needed where it is not set.
  std::optional<int> samples = {};
  /// Only these of them, for parts that are merged.
  std::optional<SampleRange> sample_range = {};
  /// Only this share of the samples, likewise; excludes `sample_range`.
  std::optional<Share> part = {};
  /// Only this share of the rows of the image, or of `crop`, likewise.
  std::optional<Share> tile = {};
  std::optional<std::string> integrator = {};    ///< by its name in the scene language
  std::optional<std::string> sampler = {};       ///< likewise
  std::optional<int> max_depth = {};             ///< surface interactions of a path, -1: unlimited
  std::optional<ImageSize> size = {};            ///< of the whole image
  std::optional<Crop> crop = {};                 ///< only these pixels
  std::optional<std::array<int, 2>> pixel = {};  ///< only the pixel x, y; excludes `crop`
  std::optional<std::uint32_t> seed = {};        ///< another seed gives another estimate
  std::optional<Heuristic> heuristic = {};
  std::optional<Masking> masking = {};  ///< of every rough BSDF
  std::optional<EmitterSelection> emitter_selection = {};
  std::optional<AreaSampling> area_sampling = {};
  std::optional<EnvironmentSampling> environment_sampling = {};
  /// Emitter samples of which one is taken, by what it would contribute unshadowed; 1 to 16.
  std::optional<int> emitter_candidates = {};
  LobeSampling sampling = LobeSampling::visible;
  /// Ends as soon as the image's relative error, the root of its relMSE, is at most this with a
  /// confidence of 95 %. No sample range, part or tile.
  std::optional<double> error = {};
  /// Ends before this time, but with one sample a pixel at least. No sample range, part or tile.
  std::optional<std::chrono::steady_clock::time_point> deadline = {};
  /// Pixels get samples by their variance, `samples` on average (at least 16). No sample range,
  /// part or tile.
  bool adaptive = false;
  bool variance = false;  ///< keep sums of squares
  /// Keep what estimate_error() is valid with for every sampler: sums of squares and, where the
  /// samples of a pixel are not independent, second estimates of some pixels.
  bool estimate_error = false;
  ProgressCallback progress = {};
};

}  // namespace facet
