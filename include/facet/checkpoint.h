#pragma once
// Renders that survive their process: what a rendering has come to, in files.
#include <facet/backend.h>

#include <filesystem>

namespace facet {

/// Where and how often a render is saved.
struct CheckpointOptions {
  std::filesystem::path file = {};  ///< an EXR, and a part (merge_parts)
  /// Seconds between two checkpoints; longer where making one takes more than a hundredth of that.
  double every = 60;
  /// Told where a checkpoint could not be written. The render goes on, and the file is as it was.
  std::function<void(const std::string& message)> on_failure = {};
};

/// Writes what a rendering has come to; whole or not at all. While its progress is told, or before
/// or after it runs. Throws Error where it cannot.
void save_checkpoint(const Rendering& rendering, const std::filesystem::path& file);

/// Sets a rendering that has not run to where a checkpoint stands; it ends with the very bits that
/// an uninterrupted one has. Returns false where there is no such file. Throws Error, which names
/// the difference, for a checkpoint of another scene, version, setting or kind of device.
bool resume(Rendering& rendering, const std::filesystem::path& file);

/// What checkpoints have cost a render.
struct CheckpointCosts {
  int written = 0;
  double seconds = 0;  ///< that the render would have been shorter by
};

/// Runs a rendering and saves it time and again, and once more where `progress` ends it. The file
/// of a render that is complete may be removed. Throws Error where the last one, of a render that
/// was ended, cannot be written; the rendering's film is there all the same.
CheckpointCosts run_with_checkpoints(Rendering& rendering, const CheckpointOptions& options,
                                     const ProgressCallback& progress = {});

}  // namespace facet
