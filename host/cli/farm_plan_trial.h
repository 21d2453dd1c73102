#pragma once
// What the file of a part takes, tried.
#include <facet/images.h>

#include "tradeoff/farm_plan.h"

namespace facet::cli {

/// Writes a film as a part into the folder for temporary files, reads it again and removes it: sets
/// the bytes and the seconds of merging, and adds those of writing to those of starting. Throws
/// InputError where there is no room for it.
void measure_part(Film film, ExrCompression compression, tradeoff::FarmMeasurement& measured);

}  // namespace facet::cli
