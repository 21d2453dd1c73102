#pragma once
// What the device works on, pass by pass, for benchmarks.
#include <array>
#include <cstddef>
#include <string_view>

namespace facet {

enum class Stage : std::size_t { first_bounce, later_bounces, film };
inline constexpr std::array<std::string_view, 3> stage_names{"first_bounce", "later_bounces",
                                                             "film"};
using StageSeconds = std::array<double, stage_names.size()>;

}  // namespace facet
