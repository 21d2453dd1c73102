#pragma once
// Image files that commands write: the options about them, checks before any work, writing.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "image/image.h"

namespace facet::cli {

[[nodiscard]] bool is_exr(const std::string& file);

/// --aov: names of further EXR channels.
void add_aov_option(CLI::App& command, std::vector<std::string>& aovs);
[[nodiscard]] bool wants_variance(const std::vector<std::string>& aovs);

/// --exposure: stops by which PNG images are brightened.
void add_exposure_option(CLI::App& command, float& exposure);

/// Throws InputError unless images of these names can be written, each once, and the report beside them
/// (empty: none, "-": standard output).
void check_outputs(const std::vector<std::string>& images, const std::string& json);

/// Throws InputError if one of the images is a PNG and the size is more than a PNG takes.
void check_png_size(const std::vector<std::string>& images, int width, int height);

/// Writes the image to every file, in the format that its extension names; then throws InputError if one of
/// them could not be written.
void write_images(const std::vector<std::string>& files, const Image& image, float exposure);

}  // namespace facet::cli
