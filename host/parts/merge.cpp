#include "parts/merge.h"

#include <algorithm>
#include <deque>
#include <future>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "image/division.h"
#include "image/film.h"
#include "parts/missing.h"

namespace facet {

namespace {

long long lacking_pixels(const PartSet& set) {
  long long lacking = area(set.pixels());
  for (const Tile& tile : set.tiles) lacking -= area(tile.pixels);
  return lacking;
}

/// Whether all pixels of the merged image would have the same samples.
bool is_even(const PartSet& set) {
  const auto has_those = [&](const Tile& tile) {
    return tile.samples == set.tiles.front().samples;
  };
  return lacking_pixels(set) == 0 && std::ranges::all_of(set.tiles, has_those);
}

/// The film of a part that was opened before.
Film read_entry(const PartEntry& part) {
  const PartFile file = open_part(part.file);
  if (file.pixels() != part.pixels || file.record.samples != part.samples)
    throw InputError(fmt::format("{}: was changed just now", part.file));
  return file.read();
}

}  // namespace

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
    throw InputError(fmt::format("missing: {}: render them{}",
                                 describe(missing, *set.record.division),
                                 is_even(set) ? ", or merge with --allow-gaps" : ""));
  const Crop pixels = set.pixels();
  const long long lacking = lacking_pixels(set);
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
    if (tile.samples != set.tiles.front().samples)
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
