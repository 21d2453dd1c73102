#pragma once
// Checkpoints: parts that also hold the state of their render (docs/reference/file-formats.md).
#include <string>

#include "image/render_state.h"
#include "parts/part_file.h"

namespace facet {

/// A part (make_part) of the samples that every pixel has, with all that continuing takes.
[[nodiscard]] Image make_checkpoint(const RenderState& state);

/// Whether a part's header is that of a checkpoint.
[[nodiscard]] bool is_checkpoint(const ExrHeader& header);

/// Whether the render of a checkpoint estimates its error (RenderRequest::estimate_error), which
/// whoever continues it has to do likewise. Throws InputError for a file that is no checkpoint or
/// that is damaged.
[[nodiscard]] bool checkpoint_estimates_error(const std::string& file);

/// What a checkpoint holds, but for the film. Throws InputError for a file that is none or that is
/// damaged.
[[nodiscard]] RenderState read_checkpoint(const std::string& file);

/// Throws InputError, which names the difference, unless the state of a file can be continued by a
/// render that stands where `own` says.
void check_continues(const RenderState& saved, const std::string& file, const RenderState& own);

/// For people: how far the render of a checkpoint has come.
[[nodiscard]] std::string describe_progress(const PartFile& checkpoint);

/// The command that continues the render of a checkpoint, with the settings that its header tells.
[[nodiscard]] std::string continue_command(const PartFile& checkpoint);

}  // namespace facet
