#pragma once
// The options of `facet render`, and what they make of a scene.
#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/reader.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace facet::cli {

struct RenderOptions {
  std::string scene;
  std::vector<std::string> outputs;
  std::optional<int> spp;
  std::optional<std::string> integrator;
  std::optional<std::string> sampler;
  std::optional<int> max_depth;
  std::optional<std::string> resolution;
  std::optional<std::string> crop;
  std::optional<std::uint32_t> seed;
  std::optional<std::string> sample_range;
  std::optional<std::string> pixel;
  std::string backend = "vulkan";
  std::string precision;
  std::string device;
  std::string sampling = "visible";
  std::string heuristic;
  std::string emitter_selection;
  std::string masking;
  std::vector<std::string> aovs;
  float exposure = 0;
  std::string json;
  bool quiet = false;
  bool strict = false;
  bool validate = false;
};

/// Adds the options that name a scene and what of it is computed.
void add_scene_options(CLI::App& command, RenderOptions& options);

/// Adds every option of `facet render`.
void add_render_options(CLI::App& command, RenderOptions& options);

/// Overrides what the scene file says.
void apply_to_scene(const RenderOptions& options, Scene& scene);
/// What apply_to_scene will replace.
[[nodiscard]] Overridden overridden_by(const RenderOptions& options);

/// The render's settings; the scene has its final size. Throws InputError for what lies outside the image.
[[nodiscard]] RenderSettings make_settings(const RenderOptions& options, const Scene& scene);

/// Files to write: those asked for, or SCENE.exr and SCENE.png here.
[[nodiscard]] std::vector<std::string> output_files(const RenderOptions& options);

}  // namespace facet::cli
