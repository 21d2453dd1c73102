#pragma once
// Parts of one render, joined.
#include <optional>

#include "parts/part_set.h"

namespace facet {

/// Throws InputError where a part holds samples outside the range.
void check_inside(const PartSet& set, const SampleRange& range);

/// Throws InputError where the parts leave pixels of their rectangle out, or tiles hold different
/// samples; and, unless gaps are allowed, where a share of the division or some sample of the range
/// (without one: of whole_samples) is missing.
void check_whole(const PartSet& set, const std::optional<SampleRange>& range, bool allow_gaps);

/// The film of all samples, with squares if all parts have them. As many parts are read at a time
/// as there are threads: it takes the memory of the film and of those. Throws InputError for
/// damaged parts.
[[nodiscard]] Film merge(const PartSet& set);

}  // namespace facet
