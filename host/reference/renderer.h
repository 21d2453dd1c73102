#pragma once
// The reference renderer: the whole path from scene to film on the CPU, in float or in double, written from
// docs/sampling.md and the papers and sharing no code with the kernels.
#include <functional>
#include <memory>
#include <vector>

#include "image/film.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "scene/statistics.h"

namespace facet::reference {

/// Renders the samples that the settings name. Real: float or double; LobeSampling::uniform ignores all
/// sampling code of the BSDFs. Ends early where progress says so.
template <typename Real>
[[nodiscard]] Film render(const Scene& scene, const RenderSettings& settings,
                          const ProgressCallback& progress, RenderStatistics& statistics);

/// Renders one sample of every pixel of the crop at a time: radiances before the filter's weight, row by row.
/// The scene must outlive the function.
template <typename Real>
[[nodiscard]] std::function<std::vector<vec3>(std::uint32_t sample)> sample_renderer(
    const Scene& scene, const RenderSettings& settings);

extern template Film render<float>(const Scene&, const RenderSettings&, const ProgressCallback&,
                                   RenderStatistics&);
extern template Film render<double>(const Scene&, const RenderSettings&, const ProgressCallback&,
                                    RenderStatistics&);

extern template std::function<std::vector<vec3>(std::uint32_t)> sample_renderer<float>(const Scene&,
                                                                                       const RenderSettings&);
extern template std::function<std::vector<vec3>(std::uint32_t)> sample_renderer<double>(
    const Scene&, const RenderSettings&);

}  // namespace facet::reference
