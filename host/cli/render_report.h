#pragma once
// What a render came to, and how it is told: the report in JSON, the header of its images, lines for people.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/render_options.h"
#include "image/error_estimate.h"
#include "scene/statistics.h"

namespace facet::cli {

struct RenderOutcome {
  Scene scene;
  RenderSettings settings;
  std::string device;
  std::string driver;
  std::vector<std::string> features;
  RenderStatistics statistics;
  Image image;
  double relmse = 0;  ///< estimated
  HeavyTails heavy_tails;
  double load_seconds = 0;
  double bvh_seconds = 0;
  double write_seconds = 0;
  bool interrupted = false;
  std::vector<std::string> files;  ///< written
};

/// Text attributes for the header of an EXR.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> make_metadata(const RenderOptions& options,
                                                                             const RenderOutcome& outcome);

/// The report that --json asks for. A path that is no UTF-8 is shown as well as it can be.
[[nodiscard]] std::string make_json_report(const RenderOptions& options, const RenderOutcome& outcome);

/// To standard error: how it went.
void print_summary(const RenderOptions& options, const RenderOutcome& outcome);

/// To standard error: what must not happen.
void print_failings(const RenderStatistics& statistics);

/// To standard error, where the estimated error of an image is not to be trusted.
void warn_about_heavy_tails(const HeavyTails& tails);

/// For reports in JSON.
[[nodiscard]] nlohmann::ordered_json json_of(const HeavyTails& tails);

}  // namespace facet::cli
