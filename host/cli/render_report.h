#pragma once
// What a render came to, and how it is told: the report in JSON, and lines for people.
#include <facet/checkpoint.h>
#include <facet/film.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "convergence/heavy_tails.h"

namespace facet::cli {

struct RenderOutcome {
  std::string scene;  ///< as it was asked for
  std::size_t triangles = 0;
  std::size_t emitters = 0;
  RenderRecord record;
  RenderStatistics statistics;
  Image image;
  bool is_pixel = false;  ///< whether the image is one pixel that was asked for
  ErrorEstimate error;
  std::optional<double> error_goal;  ///< relative error that was to be reached
  std::optional<double> time_goal;   ///< seconds of the process that were to be enough
  HeavyTails heavy_tails;
  double load_seconds = 0;
  double write_seconds = 0;
  std::optional<CheckpointCosts> checkpoints;
  bool interrupted = false;
  std::vector<std::string> files;  ///< written
};

/// A record's entries, in the order of its table. The scene is left out.
[[nodiscard]] nlohmann::ordered_json json_of(const RenderRecord& record);

/// The report that --json asks for. A path that is no UTF-8 is shown as well as it can be.
[[nodiscard]] std::string make_json_report(const RenderOutcome& outcome);

/// To standard error: how it went.
void print_summary(const RenderOutcome& outcome);

/// To standard error: what must not happen.
void print_failings(const RenderStatistics& statistics);

/// To standard error, where an error or a time that was asked for was not kept.
void warn_about_goals(const RenderOutcome& outcome);

/// For reports in JSON.
[[nodiscard]] nlohmann::ordered_json json_of(const ErrorEstimate& estimate);

/// To standard error, where the estimated error of an image is not to be trusted.
void warn_about_heavy_tails(const HeavyTails& tails);

/// For reports in JSON.
[[nodiscard]] nlohmann::ordered_json json_of(const HeavyTails& tails);

}  // namespace facet::cli
