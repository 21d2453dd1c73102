#pragma once
// Shares of a render that no part holds, and the commands that render them.
#include <string>
#include <vector>

#include "image/division.h"
#include "parts/part_set.h"

namespace facet {

/// Of the division that all parts are shares of, in order; none where there is no such division.
[[nodiscard]] std::vector<TileShare> missing_shares(const PartSet& set);

/// For people: "part 3 of 16", "parts 3,5-9 of 16", "tile 2 of 4", "parts 3,5-9 of 16 of tile 2 of
/// 4; tile 3 of 4".
[[nodiscard]] std::string describe(const std::vector<TileShare>& missing, const Division& division);

/// The command that renders a share, into the folder that the first part lies in; to be run where
/// the scene's file lies, of which a part knows the name alone.
[[nodiscard]] std::string share_command(const PartSet& set, const TileShare& share);

}  // namespace facet
