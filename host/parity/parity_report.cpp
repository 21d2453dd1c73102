#include <fmt/format.h>

#include <algorithm>

#include "parity/parity.h"

namespace facet::parity {

namespace {

/// Rounding of the filter's weights and of the sum.
constexpr double largest_film_difference = 1e-6;

}  // namespace

std::uint64_t ParityReport::unexplained() const {
  return static_cast<std::uint64_t>(std::count_if(
      diverged.begin(), diverged.end(), [](const DivergedSample& d) { return d.turned.empty(); }));
}

double ParityReport::precision_bound() const {
  return std::max(0.01 * noise_1024, image_rms / 4194304);
}

std::vector<std::string> ParityReport::failings() const {
  std::vector<std::string> list;
  if (unexplained() > 0)
    list.push_back(
        fmt::format("{} samples differ and no turned decision explains them", unexplained()));
  if (diverged.size() > diverged_allowed())
    list.push_back(
        fmt::format("{} of {} samples diverged, more than 0.1 %", diverged.size(), samples));
  if (film_difference > largest_film_difference)
    list.push_back(fmt::format(
        "the kernels' film differs from the sum of its samples by {:.2g}, more than {:.2g}",
        film_difference, largest_film_difference));
  if (miscounted_pixels > 0)
    list.push_back(
        fmt::format("the kernels' film counts the samples of {} pixels wrong", miscounted_pixels));
  if (100 * untestable > samples)
    list.push_back(fmt::format(
        "{} of {} samples are so ill-conditioned that they cannot be tested, more than 1 %",
        untestable, samples));
  if (noise_known && precision_rms > precision_bound())
    list.push_back(fmt::format(
        "float differs from double by {:.2g} RMS, more than {:.2g}, 0.01 of the noise of 1024 "
        "samples (two ulps in an image without noise)",
        precision_rms, precision_bound()));
  if (noise_known && block_z > critical_z)
    list.push_back(fmt::format(
        "a block's means in float and double differ by {:.1f} standard errors, more than {:.1f}",
        block_z, critical_z));
  if (bad_kernel_samples + bad_reference_samples > 0)
    list.push_back(fmt::format(
        "{} samples of the kernels and {} of the reference are NaN, infinite or negative",
        bad_kernel_samples, bad_reference_samples));
  return list;
}

}  // namespace facet::parity
