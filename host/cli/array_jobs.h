#pragma once
// Array jobs: which share of a render this process computes, as its engine's environment tells.
#include <facet/request.h>

#include <string>

namespace facet::cli {

/// "slurm, sge, ...".
[[nodiscard]] std::string engine_names();

/// The share that an option names: "3/16"; or "slurm" or "slurm/16", where the environment tells
/// the index, and without a number also of how many. Throws InputError, which begins with the
/// option, for any other text and where the environment lacks what is needed.
[[nodiscard]] Share read_share(const std::string& text, const char* option);

}  // namespace facet::cli
