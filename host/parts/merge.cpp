#include "parts/merge.h"

#include <sys/stat.h>

#include <algorithm>
#include <deque>
#include <future>
#include <map>
#include <tuple>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "image/division.h"
#include "image/film.h"
#include "parts/missing.h"

namespace facet {

namespace {

constexpr std::string_view separator = "; ";

/// Adds those items of a list that another does not have.
void add_items(std::string& list, std::string_view more) {
  while (!more.empty()) {
    const std::size_t end = std::min(more.find(separator), more.size());
    const std::string_view item = more.substr(0, end);
    const std::string within = fmt::format("{}{}{}", separator, list, separator);
    if (within.find(fmt::format("{}{}{}", separator, item, separator)) == std::string::npos)
      list += fmt::format("{}{}", list.empty() ? "" : separator, item);
    more.remove_prefix(std::min(end + separator.size(), more.size()));
  }
}

bool overlap(const Crop& a, const Crop& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

Crop hull(const Crop& a, const Crop& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

auto corner(const Crop& pixels) { return std::tuple(pixels.y0, pixels.x0); }

/// Makes a set, part by part.
class PartSetMaker {
 public:
  void add(const std::string& file) {
    const PartFile part = open_part(file);
    if (set_.parts.empty()) {
      first_ = part;
      set_.size = {part.header.window.full_width, part.header.window.full_height};
      set_.record.division = part.record.division;
    }
    check_same_render(part, first_);
    check_given_once(file);
    set_.parts.push_back({file, part.pixels(), part.record.samples, part.has_squares()});
    add_to_tile(set_.parts.back());
    if (part.record.division != set_.record.division) set_.record.division.reset();
    origins_.emplace_back(part.record.device, part.record.driver);
    seconds_.push_back(part.record.seconds);
  }

  PartSet finish() {
    if (set_.parts.empty()) throw InputError("there are no parts to merge");
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
    for (const std::size_t i : order) sorted.push_back(std::move(set_.parts[i]));
    set_.parts = std::move(sorted);
    std::ranges::sort(set_.tiles, {}, [](const Tile& tile) { return corner(tile.pixels); });
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

  void add_to_tile(const PartEntry& part) {
    for (Tile& tile : set_.tiles) {
      if (tile.pixels == part.pixels) {
        const SampleRanges common = tile.samples.common(part.samples);
        if (!common.empty()) fail_overlapping(part, common);
        tile.samples.add(part.samples);
        return;
      }
      if (overlap(tile.pixels, part.pixels)) fail_overlapping(part, tile);
    }
    set_.tiles.push_back({part.pixels, part.samples});
  }

  [[noreturn]] void fail_overlapping(const PartEntry& part, const SampleRanges& common) const {
    const auto other = std::ranges::find_if(set_.parts, [&](const PartEntry& p) {
      return p.pixels == part.pixels && !p.samples.common(part.samples).empty();
    });
    throw InputError(fmt::format("{}: overlaps with {}: both hold the samples {}", part.file,
                                 other->file, common.text()));
  }

  [[noreturn]] void fail_overlapping(const PartEntry& part, const Tile& tile) const {
    const auto other = std::ranges::find_if(
        set_.parts, [&](const PartEntry& p) { return p.pixels == tile.pixels; });
    throw InputError(
        fmt::format("{}: its crop is {}, but that of {} is {}: parts hold the same "
                    "pixels or have none in common",
                    part.file, crop_text(part.pixels), other->file, crop_text(tile.pixels)));
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
  std::vector<std::pair<std::string, std::string>> origins_;  ///< devices and drivers
  std::vector<double> seconds_;
  std::map<std::pair<::dev_t, ::ino_t>, std::string> known_;  ///< files by what they are
};

/// The film of a part that was opened before.
Film read_entry(const PartEntry& part) {
  const PartFile file = open_part(part.file);
  if (file.pixels() != part.pixels || file.record.samples.text() != part.samples.text())
    throw InputError(fmt::format("{}: was changed just now", part.file));
  return file.read();
}

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

void check_inside(const PartSet& set, const SampleRange& range) {
  const SampleRanges asked(range);
  for (const PartEntry& part : set.parts) {
    if (asked.missing_in(part.samples.hull()).empty()) continue;
    throw InputError(fmt::format("{}: holds samples outside --sample-range {}:{}: {}", part.file,
                                 range.begin, range.end, part.samples.text()));
  }
}

void check_whole(const PartSet& set, const std::optional<SampleRange>& range, bool allow_gaps) {
  const std::vector<TileShare> missing = missing_shares(set);
  if (!missing.empty() && !allow_gaps && !range)
    throw InputError(fmt::format("missing: {}: render them, or merge with --allow-gaps",
                                 describe(missing, *set.record.division)));
  const Crop pixels = set.pixels();
  long long lacking = area(pixels);
  for (const Tile& tile : set.tiles) lacking -= area(tile.pixels);
  if (lacking > 0)
    throw InputError(fmt::format("no part holds {} of the pixels {}", lacking, crop_text(pixels)));
  const SampleRange whole = range.value_or(set.whole_samples());
  for (const Tile& tile : set.tiles) {
    const SampleRanges gaps = tile.samples.missing_in(whole);
    const std::string where =
        set.tiles.size() == 1 ? "" : fmt::format(" for the pixels {}", crop_text(tile.pixels));
    if (!gaps.empty() && !allow_gaps)
      throw InputError(
          fmt::format("no part holds the samples {} of {}:{}{}; render them, or merge with "
                      "--allow-gaps",
                      gaps.text(), whole.begin, whole.end, where));
    if (tile.samples.text() != set.tiles.front().samples.text())
      throw InputError(fmt::format(
          "the samples {}{}, but {} for the pixels {}: all pixels of an image have the same",
          tile.samples.text(), where, set.tiles.front().samples.text(),
          crop_text(set.tiles.front().pixels)));
  }
}

Film merge(const PartSet& set) {
  const Crop pixels = set.pixels();
  const bool has_squares = std::ranges::all_of(set.parts, &PartEntry::has_squares);
  Film film = make_film(pixels.x1 - pixels.x0, pixels.y1 - pixels.y0,
                        {pixels.x0, pixels.y0, set.size.width, set.size.height}, has_squares);
  // Read side by side, added in order.
  std::deque<std::future<Film>> reading;
  auto next = set.parts.begin();
  const Activity* activity = Activity::innermost();
  while (next != set.parts.end() || !reading.empty()) {
    while (next != set.parts.end() && reading.size() < thread_count()) {
      reading.push_back(std::async([&part = *next, activity] {
        Activity::adopt(activity);
        return read_entry(part);
      }));
      ++next;
    }
    add_samples(film, reading.front().get());
    reading.pop_front();
  }
  film.record = set.record;
  // What is whole is no share any more.
  if (missing_shares(set).empty()) film.record.division.reset();
  return film;
}

}  // namespace facet
