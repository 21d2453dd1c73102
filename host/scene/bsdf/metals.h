#pragma once
// Metals by name: what the roughconductor's `material` means.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/maths.h"

namespace facet {

/// Complex index of refraction eta + i k, by channel of linear Rec. 709.
struct ConductorIor {
  Color eta;
  Color k;
};

/// A measured metal: sorted wavelengths in nanometres, and n and k at each of them.
struct MetalSpectrum {
  std::string_view name;
  std::span<const double> wavelengths;
  std::vector<double> n;
  std::vector<double> k;
};

/// The measurements, by chemical symbol: P. B. Johnson and R. W. Christy, "Optical constants of the
/// noble metals", Phys. Rev. B 6, 4370 (1972) for Ag, Au, Cu; the same, "Optical constants of
/// transition metals", Phys. Rev. B 9, 5056 (1974) for Co, Cr, Fe, Mn, Ni, Pd, Ti, V; A. D. Rakic,
/// "Algorithm for the determination of intrinsic optical constants of metal films: application to
/// aluminum", Appl. Opt. 34, 4755 (1995) for Al.
[[nodiscard]] std::span<const MetalSpectrum> metal_spectra();

/// The metal of that symbol, or nothing. n and k are averaged over the spectrum, each channel with
/// its colour matching function: CIE 1931 (fit of C. Wyman, P.-P. Sloan and P. Shirley, JCGT 2(2),
/// 2013, eq. 4) turned to Rec. 709 and scaled to give 1 for a constant. The reflectance of these
/// averages at normal incidence differs from the average of the reflectances by at most 0.002 in a
/// channel, but for Cu (0.011) and Au (0.013 in green and blue; in red, where the colour of gold
/// lies outside Rec. 709 at 1.006, the averages give 0.968).
[[nodiscard]] std::optional<ConductorIor> find_metal(std::string_view name);

[[nodiscard]] const std::vector<std::string>& metal_names();

}  // namespace facet
