#pragma once
// Records as commands: the options of facet render that make an image, or a pixel of it, again.
#include <string>
#include <string_view>
#include <vector>

#include "image/record.h"

namespace facet {

/// A word as a POSIX shell reads it back, but for ends of lines at its end: quoted where it must
/// be.
[[nodiscard]] std::string shell_word(const std::string& word);

/// The command that renders the pixel (x, y) of the whole image again, with the record's samples
/// and settings. Empty where no single command does: for a record without a scene, with gaps
/// between its samples, or of adaptive sampling.
[[nodiscard]] std::string rerun_command(const RenderRecord& record, const ImageSize& size, int x,
                                        int y);
/// The same with those entries alone that a header has; empty also where one of them is damaged.
[[nodiscard]] std::string rerun_command(const ParsedRecord& parsed, const ImageSize& size, int x,
                                        int y);

/// The options of `facet render` that say again what all shares of a render have in common, each
/// behind a blank; but for one option.
[[nodiscard]] std::string setting_options(const RenderRecord& record, std::string_view without);

/// The options of `facet render` that make the one render of the other, word by word; samples of
/// their own are named, if any.
[[nodiscard]] std::vector<std::string> options_between(const RenderRecord& from,
                                                       const RenderRecord& to);

}  // namespace facet
