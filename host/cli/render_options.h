#pragma once
// The options of `facet render`, and the request that they make.
#include <optional>
#include <string>
#include <vector>

#include "cli/backend_options.h"
#include "scene/reader.h"
#include "scene/settings.h"

namespace facet::cli {

struct RenderOptions {
  std::string scene;
  std::vector<std::string> outputs;
  /// Wishes about the render, as far as they need no parsing.
  RenderRequest request;
  std::optional<std::string> resolution;
  std::optional<std::string> crop;
  std::optional<std::string> pixel;
  std::optional<std::string> sample_range;
  std::optional<std::string> part;
  std::optional<std::string> tile;
  std::optional<std::string> error;
  std::optional<double> time;  ///< seconds, of the whole process
  std::optional<std::string> checkpoint;
  double checkpoint_every = 60;  ///< seconds
  bool resume = false;
  BackendChoice backend;
  std::vector<std::string> aovs;
  WriteOptions writing;
  std::string json;
  bool quiet = false;
  ReadingRules reading;
};

/// Adds the options that name a scene and how it is rendered.
void add_setting_options(Command& command, RenderOptions& options);

/// The same, and those for parts of the image and of its samples.
void add_scene_options(Command& command, RenderOptions& options);

/// Adds every option of `facet render`.
void add_render_options(Command& command, RenderOptions& options);

/// --seed.
template <typename Seed>
void add_seed_option(Command& command, Seed& seed) {
  command.number("--seed", seed, 0U, 0xffffffffU, "Seed of the random numbers");
}

/// --sampling, of kernels; with_uniform: also that of the reference alone.
void add_sampling_option(Command& command, LobeSampling& sampling, bool with_uniform);

/// The whole request. Throws InputError for what cannot be parsed.
[[nodiscard]] RenderRequest make_request(const RenderOptions& options);

/// A relative error: "1%" or "0.01". Throws InputError, naming the option, for anything else.
[[nodiscard]] double parse_relative_error(const std::string& text, const char* option);

/// What of the scene the options replace.
[[nodiscard]] Overridden overridden_by(const RenderOptions& options);

/// Files to write: those asked for, or SCENE.exr and SCENE.png here, or in a folder asked for.
[[nodiscard]] std::vector<std::string> output_files(const RenderOptions& options);

}  // namespace facet::cli
