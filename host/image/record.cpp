#include "image/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <limits>

#include "core/text.h"
#include "core/words.h"
#include "image/division.h"

namespace facet {

namespace {

using Text = std::optional<std::string>;

template <typename Words, typename Value>
bool set_word(const Words& words, const std::string& text, Value& value) {
  const auto found = value_of(words, text);
  if (found) value = *found;
  return found.has_value();
}

template <typename Number>
bool set_integer(const std::string& text, long long least, Number& number) {
  const auto value = parse_integer(text);
  if (!value || *value < least ||
      *value > static_cast<long long>(std::numeric_limits<Number>::max()))
    return false;
  number = static_cast<Number>(*value);
  return true;
}

bool set_text(const std::string& text, std::string& value) {
  value = text;
  return true;
}

bool set_fingerprint(const std::string& text, std::uint64_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return error == std::errc() && end == text.data() + text.size() && text.size() == 16;
}

bool set_seconds(const std::string& text, double& seconds) {
  const auto value = parse_real(text);
  if (!value || *value < 0) return false;
  seconds = *value;
  return true;
}

using R = RenderRecord;
constexpr const char* any_text = "a text";

// Samples stand before their number, which is checked against them.
constexpr std::array fields{
    RecordField{"facet.version", "version", false, nullptr, "version of facet", true, any_text,
                [](const R& r) -> Text { return r.version; },
                [](R& r, const std::string& t) { return set_text(t, r.version); }},
    RecordField{"facet.scene", "scene", false, nullptr, "scene", false, any_text,
                [](const R& r) -> Text { return r.scene; },
                [](R& r, const std::string& t) { return set_text(t, r.scene); }},
    RecordField{"facet.device", "device", false, nullptr, "device", false, any_text,
                [](const R& r) -> Text { return r.device; },
                [](R& r, const std::string& t) { return set_text(t, r.device); }},
    RecordField{"facet.driver", "driver", false, nullptr, "driver", false, any_text,
                [](const R& r) -> Text { return r.driver; },
                [](R& r, const std::string& t) { return set_text(t, r.driver); }},
    RecordField{"facet.backend", "backend", false, "--backend", "backend", true, any_text,
                [](const R& r) -> Text { return r.backend; },
                [](R& r, const std::string& t) { return set_text(t, r.backend); }},
    RecordField{
        "facet.precision", "precision", false, "--precision", "precision", true, "float or double",
        [](const R& r) -> Text { return word_of(precision_words, r.precision); },
        [](R& r, const std::string& t) { return set_word(precision_words, t, r.precision); }},
    RecordField{"facet.integrator", "integrator", false, "--integrator", "integrator", true,
                any_text, [](const R& r) -> Text { return r.integrator; },
                [](R& r, const std::string& t) { return set_text(t, r.integrator); }},
    RecordField{"facet.maxDepth", "max_depth", true, "--max-depth", "maximum depth", true,
                "an integer from -1 on",
                [](const R& r) -> Text { return fmt::format("{}", r.max_depth); },
                [](R& r, const std::string& t) { return set_integer(t, -1, r.max_depth); }},
    RecordField{
        "facet.heuristic", "heuristic", false, "--heuristic", "heuristic", true, "balance or power",
        [](const R& r) -> Text { return word_of(heuristic_words, r.heuristic); },
        [](R& r, const std::string& t) { return set_word(heuristic_words, t, r.heuristic); }},
    RecordField{
        "facet.emitterSelection", "emitter_selection", false, "--emitter-selection",
        "emitter selection", true, "contribution, power or uniform",
        [](const R& r) -> Text { return word_of(emitter_selection_words, r.emitter_selection); },
        [](R& r, const std::string& t) {
          return set_word(emitter_selection_words, t, r.emitter_selection);
        }},
    RecordField{"facet.areaSampling", "area_sampling", false, "--area-sampling",
                "sampling of area emitters", true, "area or solidangle",
                [](const R& r) -> Text { return word_of(area_sampling_words, r.area_sampling); },
                [](R& r, const std::string& t) {
                  return set_word(area_sampling_words, t, r.area_sampling);
                }},
    RecordField{"facet.environmentSampling", "environment_sampling", false,
                "--environment-sampling", "environment sampling", true, "compensated or radiance",
                [](const R& r) -> Text {
                  return word_of(environment_sampling_words, r.environment_sampling);
                },
                [](R& r, const std::string& t) {
                  return set_word(environment_sampling_words, t, r.environment_sampling);
                }},
    RecordField{"facet.emitterCandidates", "emitter_candidates", true, "--emitter-candidates",
                "candidates of an emitter sample", true, "an integer from 1 on",
                [](const R& r) -> Text { return fmt::format("{}", r.emitter_candidates); },
                [](R& r, const std::string& t) { return set_integer(t, 1, r.emitter_candidates); }},
    RecordField{"facet.sampler", "sampler", false, "--sampler", "sampler", true, any_text,
                [](const R& r) -> Text { return r.sampler; },
                [](R& r, const std::string& t) { return set_text(t, r.sampler); }},
    RecordField{
        "facet.plannedSamples", "planned_samples", true, "--spp", "planned samples per pixel", true,
        "an integer from 1 on",
        [](const R& r) -> Text { return r.planned ? Text(fmt::format("{}", *r.planned)) : Text(); },
        [](R& r, const std::string& t) { return set_integer(t, 1, r.planned.emplace()); }},
    RecordField{
        "facet.sampling", "sampling", false, "--sampling", "lobe sampling", true,
        "ndf, visible or uniform",
        [](const R& r) -> Text { return word_of(lobe_sampling_words, r.sampling); },
        [](R& r, const std::string& t) { return set_word(lobe_sampling_words, t, r.sampling); }},
    RecordField{"facet.masking", "masking", false, "--masking", "masking", true,
                "rational or exact",
                [](const R& r) -> Text {
                  return r.masking ? Text(word_of(masking_words, *r.masking)) : Text();
                },
                [](R& r, const std::string& t) { return set_word(masking_words, t, r.masking); }},
    RecordField{"facet.samples", "samples", false, "--sample-range", "samples", false,
                "ascending ranges A:B", [](const R& r) -> Text { return r.samples.text(); },
                [](R& r, const std::string& t) {
                  const auto samples = SampleRanges::parse(t);
                  r.samples = samples.value_or(SampleRanges());
                  return samples.has_value();
                }},
    RecordField{"facet.spp", "spp", true, nullptr, "samples per pixel", false,
                "the number of facet.samples",
                [](const R& r) -> Text { return fmt::format("{}", r.samples.count()); },
                [](R& r, const std::string& t) { return parse_integer(t) == r.samples.count(); }},
    RecordField{
        "facet.division", "division", false, nullptr, "division", false,
        "N parts of A:B, N tiles of X0,Y0,X1,Y1",
        [](const R& r) -> Text { return r.division ? Text(division_text(*r.division)) : Text(); },
        [](R& r, const std::string& t) {
          r.division = parse_division(t);
          return r.division.has_value();
        }},
    RecordField{"facet.adaptive", "adaptive", true, nullptr, "adaptive sampling", true, "true",
                [](const R& r) -> Text { return r.adaptive ? Text("true") : Text(); },
                [](R& r, const std::string& t) { return r.adaptive = t == "true"; }},
    RecordField{"facet.seed", "seed", true, "--seed", "seed", true, "an integer from 0 on",
                [](const R& r) -> Text { return fmt::format("{}", r.seed); },
                [](R& r, const std::string& t) { return set_integer(t, 0, r.seed); }},
    RecordField{"facet.filter", "filter", false, nullptr, "filter", true, any_text,
                [](const R& r) -> Text { return r.filter; },
                [](R& r, const std::string& t) { return set_text(t, r.filter); }},
    RecordField{"facet.fingerprint", "fingerprint", false, nullptr, "fingerprint", true,
                "sixteen hexadecimal digits",
                [](const R& r) -> Text { return fmt::format("{:016x}", r.fingerprint); },
                [](R& r, const std::string& t) { return set_fingerprint(t, r.fingerprint); }},
    RecordField{"facet.seconds", nullptr, true, nullptr, "seconds", false, "a time",
                [](const R& r) -> Text { return fmt::format("{:.3f}", r.seconds); },
                [](R& r, const std::string& t) { return set_seconds(t, r.seconds); }},
    RecordField{
        "facet.stoppedBy", "stopped_by", false, nullptr, "reason to stop", false,
        "samples, error, time or interrupt",
        [](const R& r) -> Text { return word_of(stopped_by_words, r.stopped_by); },
        [](R& r, const std::string& t) { return set_word(stopped_by_words, t, r.stopped_by); }},
};

}  // namespace

bool is_chosen(const RecordField& field, const RenderRecord& record) {
  const std::string_view key = field.key;
  // Several backends that shared a render are no choice of one.
  if (key == "facet.backend") return record.backend.find(';') == std::string::npos;
  return key != "facet.precision" || record.backend == "reference";
}

std::span<const RecordField> record_fields() { return fields; }

void add_items(std::string& list, std::string_view more) {
  constexpr std::string_view separator = "; ";
  while (!more.empty()) {
    const std::size_t end = std::min(more.find(separator), more.size());
    const std::string_view item = more.substr(0, end);
    const std::string within = fmt::format("{}{}{}", separator, list, separator);
    if (within.find(fmt::format("{}{}{}", separator, item, separator)) == std::string::npos)
      list += fmt::format("{}{}", list.empty() ? "" : separator, item);
    more.remove_prefix(std::min(end + separator.size(), more.size()));
  }
}

bool ParsedRecord::is_missing(const RecordField& field) const {
  return std::ranges::find(missing, &field) != missing.end();
}

Metadata header_of(const RenderRecord& record) {
  RenderRecord public_record = record;
  public_record.scene = std::filesystem::path(record.scene).filename().string();
  Metadata metadata;
  for (const RecordField& field : fields) {
    if (auto text = field.read(public_record)) metadata.emplace_back(field.key, std::move(*text));
  }
  return metadata;
}

ParsedRecord parse_record(const Metadata& metadata) {
  ParsedRecord parsed;
  for (const RecordField& field : fields) {
    const std::string* text = find_metadata(metadata, field.key);
    if (text == nullptr) {
      parsed.missing.push_back(&field);
    } else if (!field.write(parsed.record, *text)) {
      parsed.damaged.push_back({&field, *text});
    }
  }
  return parsed;
}

const std::string* find_metadata(const Metadata& metadata, const std::string& key) {
  const auto found =
      std::ranges::find_if(metadata, [&](const auto& entry) { return entry.first == key; });
  return found == metadata.end() ? nullptr : &found->second;
}

bool share_samples(const RenderRecord& a, const RenderRecord& b) {
  return a.scene == b.scene && a.seed == b.seed && a.sampler == b.sampler &&
         a.planned == b.planned && !a.samples.common(b.samples).empty();
}

}  // namespace facet
