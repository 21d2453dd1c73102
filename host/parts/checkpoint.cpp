#include "parts/checkpoint.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <map>
#include <sstream>
#include <stdexcept>

#include "core/error.h"
#include "core/text.h"
#include "image/division.h"
#include "image/film.h"
#include "image/film_words.h"
#include "image/record.h"
#include "image/rerun.h"
#include "parts/checksum.h"
#include "parts/part.h"

namespace facet {

namespace {

constexpr const char* state_key = "facet.state";

// ------------------------------------------------------------------------------ numbers

template <typename Number>
std::string text_of(Number value) {
  return fmt::format("{}", value);
}
std::string text_of(bool value) { return value ? "1" : "0"; }
std::string text_of(SamplingState::Stage value) {
  return fmt::format("{}", static_cast<std::uint32_t>(value));
}
std::string text_of(const std::optional<double>& value) { return value ? text_of(*value) : "none"; }

bool read(const std::string& text, std::uint64_t& value) {
  const auto number = parse_integer(text);
  if (!number || *number < 0) return false;
  value = static_cast<std::uint64_t>(*number);
  return true;
}
bool read(const std::string& text, std::uint32_t& value) {
  std::uint64_t number = 0;
  if (!read(text, number) || number > 0xffffffffU) return false;
  value = static_cast<std::uint32_t>(number);
  return true;
}
bool read(const std::string& text, bool& value) {
  value = text == "1";
  return value || text == "0";
}
bool read(const std::string& text, double& value) {
  const auto number = parse_real(text);
  if (number) value = *number;
  return number.has_value();
}
bool read(const std::string& text, SamplingState::Stage& value) {
  std::uint32_t number = 0;
  if (!read(text, number) || number > static_cast<std::uint32_t>(SamplingState::Stage::image))
    return false;
  value = static_cast<SamplingState::Stage>(number);
  return true;
}
bool read(const std::string& text, std::optional<double>& value) {
  if (text == "none") return true;
  return read(text, value.emplace());
}

/// Every number of a state beside its record, by name.
template <typename State, typename Visit>
void visit_numbers(State& state, const Visit& visit) {
  visit("stage", state.plan.stage);
  visit("pilot", state.plan.pilot);
  visit("spent", state.plan.spent);
  visit("done", state.plan.done);
  visit("more", state.plan.more);
  visit("least", state.plan.least);
  visit("wanted", state.plan.wanted);
  visit("task", state.plan.task);
  visit("sample", state.plan.sample);
  visit("length", state.plan.length);
  visit("pixel", state.plan.pixel);
  visit("first", state.first);
  visit("most", state.most);
  visit("timed", state.timed);
  visit("error", state.error);
  visit("probes", state.probes);
  visit("closestRays", state.statistics.closest_rays);
  visit("anyRays", state.statistics.any_rays);
  visit("samples", state.statistics.samples);
  visit("badSamples", state.statistics.bad_samples);
  visit("boundHits", state.statistics.bound_hits);
  visit("seconds", state.statistics.render_seconds);
}

std::string numbers_text(const RenderState& state) {
  std::string text;
  visit_numbers(state, [&](const char* name, const auto& value) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, text_of(value));
  });
  return text;
}

void read_numbers(const std::string& text, RenderState& state, const std::string& file) {
  std::map<std::string, std::string, std::less<>> entries;
  std::istringstream words(text);
  for (std::string entry; words >> entry;) {
    const std::size_t middle = std::min(entry.find('='), entry.size());
    entries[entry.substr(0, middle)] = entry.substr(std::min(middle + 1, entry.size()));
  }
  visit_numbers(state, [&](const char* name, auto& value) {
    const auto found = entries.find(name);
    if (found == entries.end() || !read(found->second, value))
      throw InputError(fmt::format("{}: damaged: {} lacks a good {}", file, state_key, name));
  });
}

/// Without planes, record and film.
RenderState numbers_of(const PartFile& checkpoint) {
  RenderState state;
  read_numbers(*find_metadata(checkpoint.header.metadata, state_key), state, checkpoint.file);
  return state;
}

// ------------------------------------------------------------------------------- planes

std::string plane_name(const char* group, std::size_t index) {
  return fmt::format("{}{}.{:02}", word_prefix, group, index);
}

void add_planes(std::vector<WordChannel>& list, const char* group,
                const std::vector<WordPlane>& planes) {
  for (std::size_t k = 0; k < planes.size(); ++k)
    list.push_back({plane_name(group, k), &planes[k]});
}

std::vector<WordPlane> read_planes(const Image& image, const char* group) {
  const std::size_t pixels =
      static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  std::vector<WordPlane> planes;
  for (;;) {
    const int channel = image.find_channel(plane_name(group, planes.size()));
    if (channel < 0) return planes;
    WordPlane& plane = planes.emplace_back(pixels);
    std::memcpy(plane.data(), image.plane(channel), pixels * sizeof(std::uint32_t));
  }
}

// --------------------------------------------------------------------------- comparison

/// Devices of one class compute alike: what stands in brackets behind a name are versions.
std::string device_class(const std::string& device) { return device.substr(0, device.find(" (")); }

PartFile described(const RenderState& state, const std::string& file) {
  PartFile part{file, {}, state.film.record};
  part.header.width = state.film.width;
  part.header.height = state.film.height;
  part.header.window = state.film.window;
  return part;
}

void check_number(const std::string& file, const char* what, const std::string& its,
                  const std::string& own) {
  if (its != own)
    throw InputError(
        fmt::format("{}: its {} is {}, but that of this render is {}", file, what, its, own));
}

void check_is_checkpoint(const ExrHeader& header, const std::string& file) {
  if (!is_checkpoint(header))
    throw InputError(
        fmt::format("{}: is no checkpoint, which facet render --checkpoint FILE.exr writes", file));
}

}  // namespace

bool is_checkpoint(const ExrHeader& header) {
  return find_metadata(header.metadata, state_key) != nullptr;
}

Image make_checkpoint(const RenderState& state) {
  const SamplingState& plan = state.plan;
  const std::vector<WordPlane> counts(plan.counts.empty() ? 0 : 1, plan.counts);
  const std::vector<WordPlane> wishes = words_of(plan.wishes);
  const std::vector<WordPlane> half = words_of(plan.first_half);
  std::vector<WordChannel> words;
  add_planes(words, "image", state.image);
  add_planes(words, "trial", state.trial);
  add_planes(words, "counts", counts);
  if (!plan.wishes.empty()) add_planes(words, "wishes", wishes);
  if (!plan.first_half.empty()) add_planes(words, "half", half);
  return make_part(state.film, false, words, {{state_key, numbers_text(state)}});
}

bool checkpoint_estimates_error(const std::string& file) {
  const ExrHeader header = read_exr_header(file);
  check_is_checkpoint(header, file);
  const PartFile checkpoint{file, header, read_record(file, header)};
  // Of independent samples the estimate needs their squares alone.
  return numbers_of(checkpoint).probes ||
         (checkpoint.has_squares() && checkpoint.record.sampler == "independent");
}

RenderState read_checkpoint(const std::string& file) {
  const Image image = read_exr(file);
  const ExrHeader header{image.width(), image.height(), image.window, image.channels(),
                         image.metadata};
  check_is_checkpoint(header, file);
  check_checksum(image, file);
  RenderState state;
  state.film =
      make_film(image.width(), image.height(), image.window, image.find_channel("square.R") >= 0);
  state.film.record = read_record(file, header);
  read_numbers(*find_metadata(image.metadata, state_key), state, file);
  state.image = read_planes(image, "image");
  state.trial = read_planes(image, "trial");
  const auto counts = read_planes(image, "counts");
  const auto wishes = read_planes(image, "wishes");
  const auto half = read_planes(image, "half");
  try {
    if (!counts.empty()) state.plan.counts = counts.front();
    if (!wishes.empty()) state.plan.wishes = doubles_of(wishes);
    if (!half.empty()) state.plan.first_half = sums_of(half);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: damaged: {}", file, error.what()));
  }
  return state;
}

void check_continues(const RenderState& saved, const std::string& file, const RenderState& own) {
  const PartFile part = described(saved, file);
  const PartFile other = described(own, "this render");
  check_same_render(part, other);
  check_same_pixels(part, other);
  const auto range = [](const RenderState& s) {
    return fmt::format("{}:{}", s.first, std::uint64_t{s.first} + s.most);
  };
  const auto has = [](bool there) { return there ? "there" : "none"; };
  check_number(file, "range of samples", range(saved), range(own));
  check_number(file, "error to stop at", text_of(saved.error), text_of(own.error));
  check_number(file, "time to stop at", has(saved.timed), has(own.timed));
  check_number(file, "second estimate of some pixels", has(saved.probes), has(own.probes));
  check_number(file, "sum of squares", has(saved.film.has_squares), has(own.film.has_squares));
  check_number(file, "kind of device", device_class(saved.film.record.device),
               device_class(own.film.record.device));
}

std::string describe_progress(const PartFile& checkpoint) {
  const RenderState state = numbers_of(checkpoint);
  std::string time = fmt::format("{:.1f} s of rendering", state.statistics.render_seconds);
  if (checkpoint.record.adaptive) return time;
  const std::string done =
      fmt::format("{} and {} samples of a pixel", time, state.plan.whole_samples());
  return state.error || state.timed ? done : fmt::format("{} of {}", done, state.most);
}

std::string continue_command(const PartFile& checkpoint) {
  const RenderState state = numbers_of(checkpoint);
  const ExrHeader& h = checkpoint.header;
  const RenderRecord& record = checkpoint.record;
  const ImageSize size{h.window.full_width, h.window.full_height};
  const SampleRange samples{state.first, state.first + state.most};
  const auto share =
      record.division ? find_share(*record.division, samples, checkpoint.pixels()) : std::nullopt;
  std::string command = "facet render";
  if (share) {
    command += share_options(*record.division, *share, size) + setting_options(record, "--spp");
  } else {
    command += fmt::format(" --resolution={}x{}", size.width, size.height);
    if (h.width != size.width || h.height != size.height)
      command += " --crop=" + crop_text(checkpoint.pixels());
    command += setting_options(record, "");
  }
  const bool open_ended = state.error || state.timed;
  if (share) {
    // It has said which samples.
  } else if (state.first > 0) {
    command += fmt::format(" --sample-range={}:{}", state.first, state.first + state.most);
  } else if (!record.planned && (!open_ended || state.most < largest_sample_count)) {
    command += fmt::format(" --spp={}", state.most);
  }
  if (record.adaptive) command += " --adaptive";
  if (state.error) command += fmt::format(" --error={}", *state.error);
  if (state.timed) command += " --time=SECONDS";
  return command + fmt::format(" --checkpoint={} --resume -- {}", shell_word(checkpoint.file),
                               shell_word(record.scene));
}

}  // namespace facet
