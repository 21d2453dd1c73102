#pragma once
// The kernels against the reference, sample by sample: G (kernels), F (reference in float), D (in
// double) of the same numbers. G - F is what the code differs by, F - D what precision costs; noise
// cancels in both.
#include <facet/backend.h>

#include <functional>

#include "parity/explain.h"

namespace facet::parity {

/// A sample beyond the tolerance.
struct DivergedSample {
  int x = 0;
  int y = 0;
  std::uint32_t sample = 0;
  Vec3<float> kernels{0};
  Vec3<float> reference{0};
  std::vector<TurnedDecision> turned;
  std::vector<std::string> reasons;  ///< the turned decisions in words; empty: unexplained
  std::string nearest;               ///< the decision that was decided by least, in words
};

/// How much more often a part of the renderer stands in unexplained samples than in others: A.
/// Ochiai's coefficient, as in spectrum-based fault localisation (R. Abreu et al. 2007); 1: in all
/// of these and in no other.
struct Suspect {
  std::string part;
  double score = 0;
  std::uint64_t failing = 0;  ///< unexplained samples that use it
  std::uint64_t passing = 0;  ///< other samples that use it
};

struct ParityReport {
  Tolerance tolerance;
  std::uint64_t samples = 0;
  std::uint64_t identical = 0;        ///< samples equal in all bits
  std::uint64_t ill_conditioned = 0;  ///< samples that agree by their spread only
  std::uint64_t untestable = 0;  ///< of these, samples whose tolerance is beyond 10 % of themselves
  double largest_difference = 0;     ///< |G - F| / |F| over samples that agree
  double percentile_difference = 0;  ///< its 99.9th percentile over all samples
  std::vector<DivergedSample> diverged;
  std::vector<Suspect> suspects;  ///< of unexplained samples, the likeliest first
  std::uint64_t bad_kernel_samples = 0;
  std::uint64_t bad_reference_samples = 0;

  /// Kernels' sums of values and squares against their own samples under the reference's filter.
  double film_difference = 0;
  std::uint64_t miscounted_pixels = 0;  ///< pixels whose samples the kernels' film counts wrong
  std::uint64_t identical_pixels = 0;
  std::uint64_t pixels = 0;

  std::uint64_t same_branches = 0;  ///< samples for which F and D decided alike
  double precision_rms = 0;         ///< RMS of F - D over them
  double largest_precision = 0;     ///< largest |F - D| over them, W sr^-1 m^-2
  bool noise_known = false;  ///< at least two samples a pixel: noise and blocks can be tested
  double noise_1024 = 0;     ///< RMS of the noise of 1024 samples a pixel
  double image_rms = 0;      ///< RMS of the samples themselves, W sr^-1 m^-2
  double block_z = 0;        ///< largest z of F against D over blocks of 16x16 pixels
  double critical_z = 0;

  [[nodiscard]] std::uint64_t unexplained() const;
  /// Diverged samples that the rule of 99.9 % allows, at least one.
  [[nodiscard]] std::uint64_t diverged_allowed() const { return (samples + 999) / 1000; }
  /// Bound of precision_rms: 0.01 of the noise; in an image without noise, two ulps.
  [[nodiscard]] double precision_bound() const;
  /// What does not hold, a line each; empty: parity.
  [[nodiscard]] std::vector<std::string> failings() const;
};

using ParityProgress = std::function<bool(double done)>;

/// Compares all samples that the settings name. kernels: a rendering of the scene by these settings
/// that has not begun.
[[nodiscard]] ParityReport check_parity(const Scene& scene, const RenderSettings& settings,
                                        const Tolerance& tolerance, Rendering& kernels,
                                        const ParityProgress& progress);

}  // namespace facet::parity
