#include "parts/merge.h"

#include <algorithm>

#include "core/error.h"
#include "image/film.h"
#include "parts/part.h"

namespace facet {

namespace {

constexpr std::string_view separator = "; ";

/// The items of a list that a text holds, each once.
void add_items(std::vector<std::string>& items, std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(separator), text.size());
    const std::string item(text.substr(0, end));
    if (std::find(items.begin(), items.end(), item) == items.end()) items.push_back(item);
    text.remove_prefix(std::min(end + separator.size(), text.size()));
  }
}

RenderRecord joined_record(const PartSet& set) {
  RenderRecord record = set.parts.front().record;
  record.samples = set.samples;
  record.seconds = 0;
  std::vector<std::string> devices;
  std::vector<std::string> drivers;
  for (const PartFile& part : set.parts) {
    record.seconds += part.record.seconds;
    add_items(devices, part.record.device);
    add_items(drivers, part.record.driver);
  }
  record.device = fmt::format("{}", fmt::join(devices, separator));
  record.driver = fmt::format("{}", fmt::join(drivers, separator));
  return record;
}

}  // namespace

PartSet open_parts(const std::vector<std::string>& files) {
  PartSet set;
  for (const std::string& file : files) {
    const PartFile& part = set.parts.emplace_back(open_part(file));
    check_same_render(part, set.parts.front());
    for (std::size_t i = 0; i + 1 < set.parts.size(); ++i) check_disjoint(part, set.parts[i]);
    set.samples.add(part.record.samples);
  }
  if (set.parts.empty()) throw InputError("there are no parts to merge");
  std::sort(set.parts.begin(), set.parts.end(), [](const PartFile& a, const PartFile& b) {
    return a.record.samples.hull().begin < b.record.samples.hull().begin;
  });
  return set;
}

void check_whole(const PartSet& set, const std::optional<SampleRange>& range) {
  const SampleRange whole = range.value_or(set.samples.hull());
  const SampleRanges missing = set.samples.missing_in(whole);
  if (missing.empty()) return;
  throw InputError(
      fmt::format("no part holds the samples {} of {}:{}; render them, or merge with --allow-gaps",
                  missing.text(), whole.begin, whole.end));
}

void check_inside(const PartSet& set, const SampleRange& range) {
  const SampleRanges asked(range);
  for (const PartFile& part : set.parts) {
    if (asked.missing_in(part.record.samples.hull()).empty()) continue;
    throw InputError(fmt::format("{}: holds samples outside --sample-range {}:{}: {}", part.file,
                                 range.begin, range.end, part.record.samples.text()));
  }
}

Film merge(const PartSet& set) {
  Film film = set.parts.front().read();
  for (std::size_t i = 1; i < set.parts.size(); ++i) add_samples(film, set.parts[i].read());
  film.record = joined_record(set);
  return film;
}

}  // namespace facet
