#include "parts/part_file.h"

#include <algorithm>

#include "core/error.h"
#include "image/division.h"
#include "image/record.h"
#include "parts/checkpoint.h"
#include "parts/checksum.h"
#include "parts/part.h"

namespace facet {

namespace {

constexpr const char* how_to_make_one = "facet render --part I/N, or --sample-range A:B, makes one";

std::string describe_size(const ExrHeader& h) {
  return fmt::format("{}x{}", h.window.full_width, h.window.full_height);
}

/// Throws InputError unless the two texts are one.
void check_same(const PartFile& part, const PartFile& first, const char* what,
                const std::string& its, const std::string& other) {
  if (its != other)
    throw InputError(fmt::format("{}: its {} is {}, but that of {} is {}", part.file, what, its,
                                 first.file, other));
}

/// A part's samples and pixels are among those that it is said to be a share of.
void check_division(const PartFile& part) {
  if (!part.record.division) return;
  const Division& d = *part.record.division;
  const Crop p = part.pixels();
  const bool inside = is_within(p, d.pixels) &&
                      SampleRanges(d.samples).missing_in(part.record.samples.hull()).empty();
  if (!inside)
    throw InputError(fmt::format("{}: damaged: its samples {} and pixels {} are no share of {}",
                                 part.file, part.record.samples.text(), crop_text(p),
                                 division_text(d)));
}

}  // namespace

RenderRecord read_record(const std::string& file, const ExrHeader& header) {
  const ParsedRecord parsed = parse_record(header.metadata);
  for (const RecordField* field : parsed.missing) {
    // What a record need not have is not missing.
    if (field->read(RenderRecord()))
      throw InputError(fmt::format("{}: is no part of a render: its header lacks {}; {}", file,
                                   field->key, how_to_make_one));
  }
  if (!parsed.damaged.empty()) {
    const auto& [field, text] = parsed.damaged.front();
    throw InputError(fmt::format("{}: damaged: {} is \"{}\", {} expected", file, field->key, text,
                                 field->expected));
  }
  return parsed.record;
}

Crop PartFile::pixels() const {
  return {header.window.x, header.window.y, header.window.x + header.width,
          header.window.y + header.height};
}

bool PartFile::has_channel(const std::string& name) const {
  return std::find(header.channels.begin(), header.channels.end(), name) != header.channels.end();
}

Film PartFile::read() const {
  const Image image = read_exr(file);
  // Looks at pixels first, which can name one.
  Film film = film_of_part(image, record.samples.count(), file);
  check_checksum(image, file);
  film.record = record;
  return film;
}

PartFile open_part(const std::string& file) {
  PartFile part{file, read_exr_header(file), {}};
  if (!part.has_channel("sum.R")) {
    const bool ours = find_metadata(part.header.metadata, "facet.samples") != nullptr;
    throw InputError(fmt::format("{}: is {}no part of a render: it holds no sums; {}", file,
                                 ours ? "a whole image and " : "", how_to_make_one));
  }
  const ImageWindow& window = part.header.window;
  if (!is_within(part.pixels(), {0, 0, window.full_width, window.full_height}))
    throw InputError(fmt::format("{}: damaged: its pixels {} lie outside its image of {}x{}", file,
                                 crop_text(part.pixels()), window.full_width, window.full_height));
  part.record = read_record(file, part.header);
  check_division(part);
  if (part.record.adaptive)
    throw InputError(fmt::format(
        "{}: its pixels have different samples (--adaptive), and parts are of the same", file));
  if (part.record.stopped_by == StoppedBy::interrupt && is_checkpoint(part.header)) {
    throw InputError(
        fmt::format("{}: is a checkpoint amid a sample, which some pixels have and others lack; "
                    "facet info tells the command that continues it",
                    file));
  }
  if (part.record.stopped_by == StoppedBy::interrupt) {
    throw InputError(fmt::format(
        "{}: its render was interrupted: it lacks some of its samples {}; render them again", file,
        part.record.samples.text()));
  }
  return part;
}

void check_same_render(const PartFile& part, const PartFile& first) {
  const bool same_scene = part.record.fingerprint == first.record.fingerprint;
  if (!same_scene) check_same(part, first, "scene", part.record.scene, first.record.scene);
  check_same(part, first, "image", describe_size(part.header), describe_size(first.header));
  for (const RecordField& field : record_fields()) {
    const auto text = [&](const PartFile& p) {
      return field.read(p.record).value_or("as the scene says");
    };
    if (field.common && std::string_view(field.key) != "facet.fingerprint")
      check_same(part, first, field.label, text(part), text(first));
  }
  if (!same_scene) {
    throw InputError(fmt::format(
        "{}: is of another version of {} than {}: the scene or a file it uses was changed "
        "(fingerprints {:016x} and {:016x})",
        part.file, part.record.scene, first.file, part.record.fingerprint,
        first.record.fingerprint));
  }
}

void check_same_pixels(const PartFile& part, const PartFile& first) {
  check_same(part, first, "crop", crop_text(part.pixels()), crop_text(first.pixels()));
}

}  // namespace facet
