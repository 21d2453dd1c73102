#pragma once
// What an image's header says of how it was made.
#include <optional>
#include <string>

#include "image/image.h"

namespace facet::cli {

/// A word as a POSIX shell reads it back: quoted where it must be.
[[nodiscard]] std::string shell_word(const std::string& word);

/// The text under a key such as "facet.scene".
[[nodiscard]] std::optional<std::string> find_metadata(const Image& image, const std::string& key);

/// The command that renders one pixel again with the samples and settings of the image; x and y count in the
/// full frame. Empty where the header does not name a scene.
[[nodiscard]] std::string rerun_command(const Image& image, int x, int y);

/// Whether both images hold some of the same samples, so that their errors are not independent.
[[nodiscard]] bool share_samples(const Image& a, const Image& b);

}  // namespace facet::cli
