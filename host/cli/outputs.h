#pragma once
// Image files that commands write: the options about them, checks before any work, writing.
#include <filesystem>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "core/diagnostics.h"
#include "image/files.h"

namespace facet::cli {

/// To standard error.
void print_warnings(const Diagnostics& diagnostics);

[[nodiscard]] bool is_exr(const std::string& file);

/// --aov: names of further EXR channels; with_error: also of those that only a render can fill.
void add_aov_option(Command& command, std::vector<std::string>& aovs, bool with_error);
[[nodiscard]] bool wants_variance(const std::vector<std::string>& aovs);
[[nodiscard]] bool wants_error(const std::vector<std::string>& aovs);

/// --exposure and --compression.
void add_writing_options(Command& command, WriteOptions& options);

/// --json.
void add_json_option(Command& command, std::string& json);
/// --json and --quiet.
void add_report_options(Command& command, std::string& json, bool& quiet);

/// Throws InputError unless images of these names can be written, each once, and the other files
/// beside them (reports and pages; empty: none, "-": standard output).
void check_outputs(const std::vector<std::string>& images, const std::vector<std::string>& others);

/// Throws InputError if one of the outputs (empty: none, "-": standard output) would take the place
/// of a file that is read.
void check_no_input_is_written(const std::vector<std::string>& outputs,
                               const std::vector<std::filesystem::path>& inputs);

/// Throws InputError if one of the images is a PNG and the size is more than a PNG takes.
void check_png_size(const std::vector<std::string>& images, int width, int height);

/// Writes the image beside every file, under another name, and removes it again: for how long that
/// takes. Errors are left to the writing itself.
void try_writing(const std::vector<std::string>& files, const Image& image,
                 const WriteOptions& options);

/// Writes the image to every file, in the format that its extension names; then throws InputError
/// if one of them could not be written. Returns where they are: an image whose folder was removed
/// meanwhile is in the current one.
[[nodiscard]] std::vector<std::string> write_images(const std::vector<std::string>& files,
                                                    const Image& image,
                                                    const WriteOptions& options);

}  // namespace facet::cli
