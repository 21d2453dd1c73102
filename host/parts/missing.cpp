#include "parts/missing.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "image/record.h"
#include "image/rerun.h"

namespace facet {

namespace {

/// "3,5-9" of ascending numbers.
std::string list_of(const std::vector<std::uint32_t>& numbers) {
  std::string list;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    list += fmt::format("{}{}", list.empty() ? "" : ",", numbers[i]);
    if (last > i) list += fmt::format("{}{}", last == i + 1 ? "," : "-", numbers[last]);
    i = last + 1;
  }
  return list;
}

std::string counted(const char* what, const std::vector<std::uint32_t>& numbers,
                    std::uint32_t count) {
  return fmt::format("{}{} {} of {}", what, numbers.size() == 1 ? "" : "s", list_of(numbers),
                     count);
}

/// The samples that every one of the pixels has.
SampleRanges held_by_all(const PartSet& set, const Crop& pixels) {
  std::optional<SampleRanges> held;
  long long lacking = area(pixels);
  for (const Tile& tile : set.tiles) {
    const Crop common{std::max(tile.pixels.x0, pixels.x0), std::max(tile.pixels.y0, pixels.y0),
                      std::min(tile.pixels.x1, pixels.x1), std::min(tile.pixels.y1, pixels.y1)};
    if (common.x0 >= common.x1 || common.y0 >= common.y1) continue;
    lacking -= area(common);
    held = held ? held->common(tile.samples) : tile.samples;
  }
  return lacking == 0 && held ? *held : SampleRanges();
}

}  // namespace

std::vector<TileShare> missing_shares(const PartSet& set) {
  std::vector<TileShare> missing;
  if (!set.record.division) return missing;
  const Division& d = *set.record.division;
  for (std::uint32_t t = 1; t <= d.tiles; ++t) {
    const Share tile{t, d.tiles};
    const Crop pixels = share_of(d.pixels, tile);
    const SampleRanges gaps = held_by_all(set, pixels).missing_in(d.samples);
    // Gaps and parts both ascend.
    auto gap = gaps.list().begin();
    for (std::uint32_t p = 1; p <= d.parts && gap != gaps.list().end(); ++p) {
      const Share part{p, d.parts};
      const SampleRange samples = share_of(d.samples, part);
      if (gap->begin < samples.end) missing.push_back({part, tile});
      while (gap != gaps.list().end() && gap->end <= samples.end) ++gap;
    }
  }
  return missing;
}

std::string describe(const std::vector<TileShare>& missing, const Division& division) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> parts_of_tiles;
  for (const TileShare& share : missing)
    parts_of_tiles[share.tile.index].push_back(share.part.index);
  std::vector<std::uint32_t> whole_tiles;
  std::vector<std::string> items;
  for (const auto& [tile, parts] : parts_of_tiles) {
    if (division.tiles > 1 && parts.size() == division.parts) {
      whole_tiles.push_back(tile);
      continue;
    }
    items.push_back(counted("part", parts, division.parts));
    if (division.tiles > 1) items.back() += fmt::format(" of tile {} of {}", tile, division.tiles);
  }
  if (!whole_tiles.empty()) items.push_back(counted("tile", whole_tiles, division.tiles));
  return fmt::format("{}", fmt::join(items, "; "));
}

std::string share_command(const PartSet& set, const TileShare& share) {
  const RenderRecord& record = set.record;
  const Division& d = *record.division;
  std::string command = "facet render" + share_options(d, share, set.size);
  command += setting_options(record, "--spp");
  if (set.parts.front().has_squares) command += " --aov=variance";
  const std::filesystem::path folder = std::filesystem::path(set.parts.front().file).parent_path();
  const std::string name =
      share_file(std::filesystem::path(record.scene).stem().string(),
                 d.parts > 1 || d.tiles == 1 ? std::optional(share.part) : std::nullopt,
                 d.tiles > 1 ? std::optional(share.tile) : std::nullopt);
  return command + fmt::format(" --output={} -- {}", shell_word((folder / name).string()),
                               shell_word(record.scene));
}

}  // namespace facet
