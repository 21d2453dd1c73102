#include "cli/outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "core/error.h"
#include "core/print.h"
#include "core/text.h"
#include "image/files.h"

namespace facet::cli {

void print_warnings(const Diagnostics& diagnostics) {
  for (const std::string& warning : diagnostics.warnings()) say("warning: {}\n", warning);
}

namespace {

constexpr std::array compression_words{Word{ExrCompression::zip, "zip"},
                                       Word{ExrCompression::uncompressed, "none"}};

/// Absolute first: weakly_canonical leaves "a.exr" as it is, but not "./a.exr".
std::filesystem::path whole_path(const std::filesystem::path& file) {
  return std::filesystem::weakly_canonical(std::filesystem::absolute(file));
}

/// Where the file's folder has gone since the command began, the image goes to the current one.
/// Returns the path it has.
std::string write_image(const std::string& file, const Image& image, const WriteOptions& options) {
  const std::filesystem::path path(file);
  std::error_code unknown;
  const bool lost = path.has_parent_path() && !std::filesystem::exists(path.parent_path(), unknown);
  std::string place = lost ? path.filename().string() : file;
  if (lost && std::filesystem::exists(place, unknown))
    throw InputError(fmt::format(
        "{}: cannot write: no such folder any more, and {} is in the current one", file, place));
  facet::write_image(place, image, options);
  if (lost) say("warning: {}: no such folder any more; the image is in {}\n", file, place);
  return place;
}

}  // namespace

bool is_exr(const std::string& file) { return output_format(file) == ImageFormat::exr; }

void add_aov_option(Command& command, std::vector<std::string>& aovs, bool with_error) {
  std::string help = "Further EXR channels: variance (of each pixel's mean";
  std::vector<std::string> names{"variance"};
  if (with_error) {
    help +=
        ", as if its samples were independent), error (standard error of each pixel's mean, "
        "whatever the sampler";
    names.emplace_back("error");
  }
  command.list("--aov", aovs, help + ")", names);
}

bool wants_variance(const std::vector<std::string>& aovs) {
  return std::find(aovs.begin(), aovs.end(), "variance") != aovs.end();
}

bool wants_error(const std::vector<std::string>& aovs) {
  return std::find(aovs.begin(), aovs.end(), "error") != aovs.end();
}

void add_writing_options(Command& command, WriteOptions& options) {
  command.number("--exposure", options.exposure, -100.F, 100.F,
                 "Stops by which PNG images are brightened");
  command.word("--compression", options.compression, compression_words,
               "How EXRs are packed; none: larger, and several times as fast to merge");
}

void add_json_option(Command& command, std::string& json) {
  command.text("--json", json, "Write a report to this file, - for standard output");
}

void add_report_options(Command& command, std::string& json, bool& quiet) {
  add_json_option(command, json);
  command.flag("--quiet", quiet, "Nothing but errors and warnings on standard error");
}

void check_outputs(const std::vector<std::string>& images, const std::vector<std::string>& others) {
  std::set<std::filesystem::path> names;
  std::vector<std::string> all = images;
  for (const std::string& file : images) (void)output_format(file);
  for (const std::string& file : others) {
    if (!file.empty() && file != "-") all.push_back(file);
  }
  for (const std::string& file : all) {
    check_writable(file);
    if (!names.insert(whole_path(file)).second)
      throw InputError(fmt::format("{}: is to be written twice", file));
  }
}

void check_no_input_is_written(const std::vector<std::string>& outputs,
                               const std::vector<std::filesystem::path>& inputs) {
  for (const std::string& output : outputs) {
    std::error_code missing;
    if (output.empty() || output == "-" || std::filesystem::is_other(output, missing)) continue;
    const std::filesystem::path whole = whole_path(output);
    for (const std::filesystem::path& input : inputs) {
      // Links of both kinds lead to one and the same file.
      if (whole == whole_path(input) || std::filesystem::equivalent(output, input, missing))
        throw InputError(fmt::format("{}: is to be read and written", output));
    }
  }
}

void check_png_size(const std::vector<std::string>& images, int width, int height) {
  constexpr int largest_png_side = 1000000;
  if (std::max(width, height) <= largest_png_side) return;
  for (const std::string& file : images) {
    if (is_exr(file)) continue;
    throw InputError(fmt::format("{}: a PNG's sides are at most {} pixels; write an EXR", file,
                                 largest_png_side));
  }
}

void try_writing(const std::vector<std::string>& files, const Image& image,
                 const WriteOptions& options) {
  for (const std::string& file : files) {
    const std::filesystem::path path(file);
    std::error_code unknown;
    if (std::filesystem::is_other(path, unknown)) continue;
    const std::filesystem::path trial =
        path.parent_path() /
        fmt::format(".facet-trial-{}{}", ::getpid(), path.extension().string());
    try {
      facet::write_image(trial, image, options);
    } catch (const InputError&) {
    }
    std::filesystem::remove(trial, unknown);
  }
}

std::vector<std::string> write_images(const std::vector<std::string>& files, const Image& image,
                                      const WriteOptions& options) {
  std::vector<std::string> written;
  std::string failures;
  for (const std::string& file : files) {
    try {
      written.push_back(write_image(file, image, options));
    } catch (const InputError& error) {
      failures += (failures.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  if (!failures.empty()) throw InputError(failures);
  return written;
}

}  // namespace facet::cli
