#include "parts/part_set.h"

#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "core/error.h"
#include "image/division.h"
#include "image/record.h"

namespace facet {

namespace {

bool overlap(const Crop& a, const Crop& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

Crop hull(const Crop& a, const Crop& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

auto corner(const Crop& pixels) { return std::tuple(pixels.y0, pixels.x0); }

/// Whether the tile is cut from the part.
bool covers(const PartEntry& part, const Tile& tile) {
  return part.pixels.x0 == tile.pixels.x0 && part.pixels.x1 == tile.pixels.x1 &&
         is_within(tile.pixels, part.pixels);
}

/// Makes a set, part by part.
class PartSetMaker {
 public:
  void add(const std::string& file) {
    const PartFile part = open_part(file);
    if (set_.parts.empty()) {
      first_ = part;
      set_.size = {part.header.window.full_width, part.header.window.full_height};
    }
    check_same_render(part, first_);
    check_given_once(file);
    check_same_division(part);
    set_.parts.push_back({file, part.pixels(), part.record.samples, part.has_squares()});
    origins_.emplace_back(part.record.device, part.record.driver);
    seconds_.push_back(part.record.seconds);
  }

  PartSet finish() {
    if (set_.parts.empty()) throw InputError("there are no parts to merge");
    make_tiles();
    const std::optional<Division> division = set_.record.division;
    std::vector<std::size_t> order(set_.parts.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto place = [&](std::size_t i) {
      const PartEntry& part = set_.parts[i];
      return std::tuple_cat(corner(part.pixels), std::tuple(part.samples.hull().begin));
    };
    std::ranges::sort(order, {}, place);
    set_.record = open_part(set_.parts[order[0]].file).record;
    set_.record.division = division;
    join_records(order);
    std::vector<PartEntry> sorted;
    sorted.reserve(order.size());
    for (const std::size_t i : order) sorted.push_back(std::move(set_.parts[i]));
    set_.parts = std::move(sorted);
    set_.record.samples = set_.samples();
    return std::move(set_);
  }

 private:
  void check_given_once(const std::string& file) {
    struct ::stat status {};
    if (::stat(file.c_str(), &status) != 0) return;
    const bool is_new = known_.insert({{status.st_dev, status.st_ino}, file}).second;
    if (!is_new) throw InputError(fmt::format("{}: is given twice", file));
  }

  /// What is a share of something else would pass for more than it is.
  void check_same_division(const PartFile& part) {
    if (!part.record.division) return;
    if (divided_.empty()) {
      divided_ = part.file;
      set_.record.division = part.record.division;
    } else if (part.record.division != set_.record.division) {
      throw InputError(fmt::format("{}: is of {}, but {} is of {}", part.file,
                                   division_text(*part.record.division), divided_,
                                   division_text(*set_.record.division)));
    }
  }

  /// Cuts the image where parts begin and end, so that each tile has the pixels of some parts whole
  /// and none of the others.
  void make_tiles() {
    std::map<std::pair<int, int>, std::set<int>> edges;  // rows, of what has the same columns
    for (const PartEntry& part : set_.parts)
      edges[{part.pixels.x0, part.pixels.x1}].insert({part.pixels.y0, part.pixels.y1});
    for (const auto& [columns, rows] : edges) {
      for (auto row = rows.begin(); std::next(row) != rows.end(); ++row)
        set_.tiles.push_back({{columns.first, *row, columns.second, *std::next(row)}, {}});
    }
    std::ranges::sort(set_.tiles, {}, [](const Tile& tile) { return corner(tile.pixels); });
    for (const PartEntry& part : set_.parts) {
      for (Tile& tile : set_.tiles) {
        if (covers(part, tile)) {
          if (!tile.samples.common(part.samples).empty()) fail_overlapping(part, tile);
          tile.samples.add(part.samples);
        }
      }
    }
    std::erase_if(set_.tiles, [](const Tile& tile) { return tile.samples.empty(); });
    check_apart();
  }

  /// Throws InputError where tiles of different columns have pixels in common.
  void check_apart() const {
    for (std::size_t i = 0; i < set_.tiles.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (!overlap(set_.tiles[i].pixels, set_.tiles[j].pixels)) continue;
        const PartEntry& part = part_of(set_.tiles[i]);
        const PartEntry& other = part_of(set_.tiles[j]);
        throw InputError(
            fmt::format("{}: its crop is {}, but that of {} is {}: parts have the same "
                        "columns, or no pixels in common",
                        part.file, crop_text(part.pixels), other.file, crop_text(other.pixels)));
      }
    }
  }

  [[nodiscard]] const PartEntry& part_of(const Tile& tile) const {
    return *std::ranges::find_if(set_.parts, [&](const PartEntry& p) { return covers(p, tile); });
  }

  [[noreturn]] void fail_overlapping(const PartEntry& part, const Tile& tile) const {
    for (const PartEntry& other : set_.parts) {
      const SampleRanges common = other.samples.common(part.samples);
      if (&other == &part || !covers(other, tile) || common.empty()) continue;
      throw InputError(fmt::format("{}: overlaps with {}: both hold the samples {}", part.file,
                                   other.file, common.text()));
    }
    throw std::logic_error("parts that overlap with none");
  }

  /// In the order of the parts, which the files' must not matter for.
  void join_records(const std::vector<std::size_t>& order) {
    RenderRecord& record = set_.record;
    record.device.clear();
    record.driver.clear();
    record.seconds = 0;
    for (const std::size_t i : order) {
      add_items(record.device, origins_[i].first);
      add_items(record.driver, origins_[i].second);
      record.seconds += seconds_[i];
    }
  }

  PartSet set_;
  PartFile first_;
  std::string divided_;                                       ///< the first part that is a share
  std::vector<std::pair<std::string, std::string>> origins_;  ///< devices and drivers
  std::vector<double> seconds_;
  std::map<std::pair<::dev_t, ::ino_t>, std::string> known_;  ///< files by what they are
};

}  // namespace

Crop PartSet::pixels() const {
  Crop all = tiles.front().pixels;
  for (const Tile& tile : tiles) all = hull(all, tile.pixels);
  return all;
}

SampleRange PartSet::whole_samples() const {
  if (record.division) return record.division->samples;
  SampleRange all = tiles.front().samples.hull();
  for (const Tile& tile : tiles) {
    const SampleRange more = tile.samples.hull();
    all = {std::min(all.begin, more.begin), std::max(all.end, more.end)};
  }
  return all;
}

SampleRanges PartSet::samples() const {
  SampleRanges all = tiles.front().samples;
  for (const Tile& tile : tiles) all = all.common(tile.samples);
  return all;
}

PartSet open_parts(const std::vector<std::string>& files) {
  PartSetMaker maker;
  for (const std::string& file : files) maker.add(file);
  return maker.finish();
}

}  // namespace facet
