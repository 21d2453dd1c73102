#pragma once
// The table of provenance: how each entry of a RenderRecord is called and what it means. Whatever
// reads or writes a record follows the table: EXR headers, JSON reports, commands that render
// again, merging.
#include <facet/film.h>

#include <span>

namespace facet {

/// Text under keys, as EXR headers hold it.
using Metadata = std::vector<std::pair<std::string, std::string>>;

struct RecordField {
  const char* key;       ///< in EXR headers
  const char* json;      ///< in JSON reports; nullptr: not there
  bool numeric;          ///< whether JSON has a number, not a text
  const char* option;    ///< of `facet render`, which sets it; nullptr: none does
  const char* label;     ///< for messages
  bool common;           ///< must be the same in all parts of one render
  const char* expected;  ///< what `write` takes, for messages
  /// Nothing where the record does not say.
  std::optional<std::string> (*read)(const RenderRecord& record);
  /// Returns whether the text can be such an entry.
  bool (*write)(RenderRecord& record, const std::string& text);
};

/// In the order of headers and reports.
[[nodiscard]] std::span<const RecordField> record_fields();

/// Whether the field is a choice at all: the kernels have none of precision.
[[nodiscard]] bool is_chosen(const RecordField& field, const RenderRecord& record);

/// An entry that is not what it should be.
struct DamagedField {
  const RecordField* field;
  std::string text;
};

struct ParsedRecord {
  RenderRecord record;
  std::vector<const RecordField*> missing;
  std::vector<DamagedField> damaged;

  [[nodiscard]] bool is_missing(const RecordField& field) const;
};

/// Adds those items of a list that another lacks. Lists are those of a record's devices, drivers
/// and backends: several have "; " between.
void add_items(std::string& list, std::string_view more);

/// The record as a header holds it; of the scene's path only the file's name.
[[nodiscard]] Metadata header_of(const RenderRecord& record);

/// The reverse; other keys are left aside.
[[nodiscard]] ParsedRecord parse_record(const Metadata& metadata);

/// The text of a key, nullptr if there is none.
[[nodiscard]] const std::string* find_metadata(const Metadata& metadata, const std::string& key);

/// Whether two renders hold some of the same samples, so that their errors are not independent.
[[nodiscard]] bool share_samples(const RenderRecord& a, const RenderRecord& b);

}  // namespace facet
