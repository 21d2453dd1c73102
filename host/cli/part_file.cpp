#include "cli/part_file.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/error.h"
#include "core/text.h"
#include "image/part.h"

namespace facet::cli {

namespace {

constexpr const char* how_to_make_one = "facet render --sample-range A:B -o PART.exr makes one";

/// What all parts have in common: keys of the metadata, and what they are called.
constexpr std::array<std::pair<const char*, const char*>, 12> common_keys{{
    {"facet.version", "version of facet"},
    {"facet.backend", "backend"},
    {"facet.precision", "precision"},
    {"facet.integrator", "integrator"},
    {"facet.maxDepth", "maximum depth"},
    {"facet.heuristic", "heuristic"},
    {"facet.emitterSelection", "emitter selection"},
    {"facet.sampler", "sampler"},
    {"facet.sampling", "lobe sampling"},
    {"facet.seed", "seed"},
    {"facet.filter", "filter"},
    {"facet.fingerprint", "scene"},
}};

std::string describe_size(const ExrHeader& h) {
  return fmt::format("{}x{}", h.window.full_width, h.window.full_height);
}

std::string describe_crop(const ExrHeader& h) {
  return fmt::format("{},{},{},{}", h.window.x, h.window.y, h.window.x + h.width, h.window.y + h.height);
}

[[noreturn]] void fail_different(const PartFile& part, const PartFile& first, const std::string& what,
                                 const std::string& its, const std::string& other) {
  throw InputError(
      fmt::format("{}: its {} is {}, but that of {} is {}", part.file, what, its, first.file, other));
}

void check_same_scene_content(const PartFile& part, const PartFile& first) {
  const std::string& its = part.text("facet.fingerprint");
  const std::string& other = first.text("facet.fingerprint");
  if (its == other) return;
  throw InputError(
      fmt::format("{}: is of another version of {} than {}: the scene or a file it uses was changed "
                  "(fingerprints {} and {})",
                  part.file, part.text("facet.scene"), first.file, its, other));
}

[[noreturn]] void fail_damaged(const PartFile& part, const char* key, const std::string& expected) {
  throw InputError(
      fmt::format("{}: damaged: {} is \"{}\", {} expected", part.file, key, part.text(key), expected));
}

/// Throws InputError where the header's numbers are none, or contradict each other.
void check_numbers(const PartFile& part) {
  const std::uint32_t samples = part.samples.count();
  if (parse_integer(part.text("facet.spp")) != samples) {
    fail_damaged(part, "facet.spp",
                 fmt::format("{} by facet.samples {},", samples, part.text("facet.samples")));
  }
  if (parse_integer(part.text("facet.seed")).value_or(-1) < 0)
    fail_damaged(part, "facet.seed", "an integer from 0 on");
  if (!(parse_real(part.text("facet.seconds")).value_or(-1) >= 0))
    fail_damaged(part, "facet.seconds", "a time");
}

}  // namespace

const std::string& PartFile::text(const std::string& key) const {
  const std::string* text = find_metadata(header.metadata, key);
  if (text == nullptr) {
    throw InputError(
        fmt::format("{}: is no part of a render: its header lacks {}; {}", file, key, how_to_make_one));
  }
  return *text;
}

bool PartFile::has_channel(const std::string& name) const {
  return std::find(header.channels.begin(), header.channels.end(), name) != header.channels.end();
}

Film PartFile::read() const { return film_of_part(read_exr(file), samples.count(), file); }

PartFile open_part(const std::string& file) {
  PartFile part{file, read_exr_header(file), {}};
  if (!part.has_channel("sum.R")) {
    const bool ours = find_metadata(part.header.metadata, "facet.samples") != nullptr;
    throw InputError(fmt::format("{}: is {}no part of a render: it holds no sums; {}", file,
                                 ours ? "a whole image and " : "", how_to_make_one));
  }
  const auto samples = SampleRanges::parse(part.text("facet.samples"));
  if (!samples) fail_damaged(part, "facet.samples", "ascending ranges A:B");
  part.samples = *samples;
  if (part.text("facet.complete") != "yes") {
    throw InputError(
        fmt::format("{}: its render was interrupted: it lacks some of its samples {}; render them again",
                    file, part.samples.text()));
  }
  for (const auto& [key, name] : common_keys) (void)part.text(key);
  check_numbers(part);
  return part;
}

void check_same_render(const PartFile& part, const PartFile& first) {
  const bool same_scene = part.text("facet.fingerprint") == first.text("facet.fingerprint");
  if (!same_scene && part.text("facet.scene") != first.text("facet.scene"))
    fail_different(part, first, "scene", part.text("facet.scene"), first.text("facet.scene"));
  if (describe_size(part.header) != describe_size(first.header))
    fail_different(part, first, "image", describe_size(part.header), describe_size(first.header));
  if (describe_crop(part.header) != describe_crop(first.header))
    fail_different(part, first, "crop", describe_crop(part.header), describe_crop(first.header));
  for (const auto& [key, name] : common_keys) {
    if (std::string_view(key) == "facet.fingerprint") {
      check_same_scene_content(part, first);
    } else if (part.text(key) != first.text(key)) {
      fail_different(part, first, name, part.text(key), first.text(key));
    }
  }
}

void check_disjoint(const PartFile& part, const PartFile& first) {
  std::error_code ignored;
  if (std::filesystem::equivalent(part.file, first.file, ignored))
    throw InputError(fmt::format("{}: is given twice", part.file));
  const SampleRanges common = part.samples.common(first.samples);
  if (common.empty()) return;
  throw InputError(
      fmt::format("{}: overlaps with {}: both hold the samples {}", part.file, first.file, common.text()));
}

}  // namespace facet::cli
