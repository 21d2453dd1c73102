#include "scene/bsdf/metals.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace facet {

namespace {

// Both papers of Johnson and Christy sample the same photon energies.
constexpr std::array johnson_christy{367.9, 381.5, 397.4, 413.3, 430.5, 450.9, 471.4, 495.9,
                                     520.9, 548.6, 582.1, 616.8, 659.5, 704.5, 756.0};
constexpr std::array rakic{364.66, 413.28, 442.80, 476.87, 516.60, 563.57,
                           619.93, 652.25, 688.81, 729.32, 774.91};

const std::array<MetalSpectrum, 12> spectra{{
    {"Ag",
     johnson_christy,
     {0.07, 0.05, 0.05, 0.05, 0.04, 0.04, 0.05, 0.05, 0.05, 0.06, 0.05, 0.06, 0.05, 0.04, 0.03},
     {1.657, 1.864, 2.070, 2.275, 2.462, 2.657, 2.869, 3.093, 3.324, 3.586, 3.858, 4.152, 4.483,
      4.838, 5.242}},
    {"Al",
     rakic,
     {0.39877, 0.52135, 0.60790, 0.72780, 0.87340, 1.0728, 1.3660, 1.5724, 1.8301, 2.1606, 2.6154},
     {4.3957, 5.0008, 5.3676, 5.7781, 6.2418, 6.7839, 7.4052, 7.7354, 8.0601, 8.3565, 8.4914}},
    {"Au",
     johnson_christy,
     {1.48, 1.46, 1.47, 1.46, 1.45, 1.38, 1.31, 1.04, 0.62, 0.43, 0.29, 0.21, 0.14, 0.13, 0.14},
     {1.895, 1.933, 1.952, 1.958, 1.948, 1.914, 1.849, 1.833, 2.081, 2.455, 2.863, 3.272, 3.697,
      4.103, 4.542}},
    {"Co",
     johnson_christy,
     {1.50, 1.53, 1.57, 1.61, 1.67, 1.74, 1.81, 1.88, 1.97, 2.05, 2.13, 2.19, 2.25, 2.31, 2.40},
     {2.71, 2.82, 2.93, 3.05, 3.17, 3.28, 3.41, 3.55, 3.68, 3.82, 3.96, 4.11, 4.27, 4.45, 4.64}},
    {"Cr",
     johnson_christy,
     {1.87, 1.92, 2.00, 2.08, 2.19, 2.33, 2.51, 2.75, 2.94, 3.18, 3.22, 3.17, 3.09, 3.05, 3.08},
     {2.69, 2.74, 2.83, 2.93, 3.04, 3.14, 3.24, 3.30, 3.33, 3.33, 3.30, 3.30, 3.34, 3.39, 3.42}},
    {"Cu",
     johnson_christy,
     {1.36, 1.33, 1.32, 1.28, 1.25, 1.24, 1.25, 1.22, 1.18, 1.02, 0.70, 0.30, 0.22, 0.21, 0.24},
     {1.975, 2.045, 2.116, 2.207, 2.305, 2.397, 2.483, 2.564, 2.608, 2.577, 2.704, 3.205, 3.747,
      4.205, 4.665}},
    {"Fe",
     johnson_christy,
     {2.02, 2.12, 2.24, 2.35, 2.48, 2.59, 2.67, 2.74, 2.86, 2.95, 2.94, 2.88, 2.92, 2.86, 2.87},
     {2.43, 2.50, 2.58, 2.65, 2.71, 2.77, 2.82, 2.88, 2.91, 2.93, 2.99, 3.05, 3.10, 3.19, 3.28}},
    {"Mn",
     johnson_christy,
     {1.89, 1.92, 1.96, 2.00, 2.06, 2.11, 2.19, 2.25, 2.32, 2.39, 2.47, 2.51, 2.56, 2.62, 2.70},
     {2.59, 2.67, 2.74, 2.82, 2.90, 2.98, 3.06, 3.14, 3.23, 3.33, 3.43, 3.54, 3.65, 3.78, 3.91}},
    {"Ni",
     johnson_christy,
     {1.70, 1.72, 1.72, 1.70, 1.71, 1.73, 1.78, 1.82, 1.85, 1.92, 1.96, 1.99, 1.99, 2.06, 2.13},
     {2.40, 2.48, 2.57, 2.69, 2.82, 2.95, 3.09, 3.25, 3.42, 3.61, 3.80, 4.02, 4.26, 4.50, 4.73}},
    {"Pd",
     johnson_christy,
     {1.24, 1.26, 1.30, 1.33, 1.37, 1.41, 1.46, 1.52, 1.57, 1.64, 1.68, 1.75, 1.80, 1.86, 1.95},
     {2.74, 2.83, 2.93, 3.03, 3.14, 3.26, 3.39, 3.54, 3.68, 3.84, 4.02, 4.21, 4.42, 4.65, 4.89}},
    {"Ti",
     johnson_christy,
     {1.90, 1.99, 2.08, 2.14, 2.21, 2.27, 2.32, 2.36, 2.44, 2.54, 2.60, 2.67, 2.76, 2.86, 3.00},
     {2.90, 2.93, 2.95, 2.98, 3.01, 3.04, 3.10, 3.19, 3.30, 3.43, 3.58, 3.72, 3.84, 3.96, 4.01}},
    {"V",
     johnson_christy,
     {2.68, 2.87, 3.07, 3.31, 3.52, 3.59, 3.81, 3.92, 3.86, 4.00, 3.83, 3.54, 3.25, 3.18, 3.20},
     {3.40, 3.45, 3.48, 3.49, 3.49, 3.46, 3.38, 3.26, 3.18, 3.04, 3.00, 3.02, 3.09, 3.15, 3.20}},
}};

/// Linear between samples, constant beyond them.
double interpolate(std::span<const double> x, std::span<const double> y, double at) {
  const auto next = std::upper_bound(x.begin(), x.end(), at);
  if (next == x.begin()) return y.front();
  if (next == x.end()) return y.back();
  const auto i = static_cast<std::size_t>(next - x.begin());
  const double t = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return y[i - 1] * (1 - t) + y[i] * t;
}

/// A Gaussian whose widths differ below and above its peak.
double lobe(double x, double peak, double below, double above) {
  const double t = (x - peak) / (x < peak ? below : above);
  return std::exp(-t * t / 2);
}

/// CIE 1931 at a wavelength in nanometres, by Wyman, Sloan and Shirley's fit.
dvec3 matching_xyz(double w) {
  return {1.056 * lobe(w, 599.8, 37.9, 31.0) + 0.362 * lobe(w, 442.0, 16.0, 26.7) -
              0.065 * lobe(w, 501.1, 20.4, 26.2),
          0.821 * lobe(w, 568.8, 46.9, 40.5) + 0.286 * lobe(w, 530.9, 16.3, 31.1),
          1.217 * lobe(w, 437.0, 11.8, 36.0) + 0.681 * lobe(w, 459.0, 26.0, 13.8)};
}

/// ITU-R BT.709 primaries and D65.
dvec3 rec709(const dvec3& xyz) {
  return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
          -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
          0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

ConductorIor averages(const MetalSpectrum& metal) {
  dvec3 eta(0);
  dvec3 k(0);
  dvec3 weights(0);
  for (int w = 380; w <= 750; ++w) {
    const dvec3 weight = rec709(matching_xyz(w));
    eta += weight * interpolate(metal.wavelengths, metal.n, w);
    k += weight * interpolate(metal.wavelengths, metal.k, w);
    weights += weight;
  }
  return {Color(eta / weights), Color(k / weights)};
}

}  // namespace

std::span<const MetalSpectrum> metal_spectra() { return spectra; }

std::optional<ConductorIor> find_metal(std::string_view name) {
  const auto* const found = std::find_if(spectra.begin(), spectra.end(),
                                         [&](const MetalSpectrum& m) { return m.name == name; });
  return found == spectra.end() ? std::nullopt : std::optional(averages(*found));
}

const std::vector<std::string>& metal_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const MetalSpectrum& metal : spectra) list.emplace_back(metal.name);
    return list;
  }();
  return names;
}

}  // namespace facet
