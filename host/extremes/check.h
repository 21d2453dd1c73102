#pragma once
// The table of extremes as data: what is checked, and what was found.
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace facet::extremes {

class Bench;

/// What a check has measured.
struct Finding {
  std::uint64_t inputs = 0;
  double worst = 0;  ///< infinite where something that must not be has been found
  std::string at;    ///< the input that made it, as one can type it in again

  /// Counts an input, and keeps its deviation where it is the largest so far, with describe() of
  /// the input. A deviation below 0 says that it is no input; NaN counts as infinite.
  template <typename Describe>
  void add(double deviation, const Describe& describe) {
    if (deviation < 0) return;
    if (std::isnan(deviation)) deviation = std::numeric_limits<double>::infinity();
    ++inputs;
    if (deviation <= worst) return;
    worst = deviation;
    at = describe();
  }

  /// Counts inputs of which so many are wrong, and describes the first that are: the worst is their
  /// number.
  template <typename Describe>
  void count(std::uint64_t tried, std::uint64_t wrong, const Describe& describe) {
    inputs += tried;
    if (wrong == 0) return;
    if (worst == 0) at = describe();
    worst += static_cast<double>(wrong);
  }
};

/// One row of the table: over a range of inputs, something stays within a limit.
struct Check {
  std::string group;
  std::string name;
  std::string range;  ///< of the inputs, in words
  std::string unit;   ///< of worst and limit
  double limit = 0;
  /// What is lost where it does not hold; of the premise alone.
  std::string promise;
  /// Why it need not hold; empty where it has to.
  std::string argued;
  std::function<Finding(Bench&)> measure;
};

/// Without a promise or an argument, and still to be told how to measure.
[[nodiscard]] inline Check make_check(std::string group, std::string name, std::string range,
                                      std::string unit, double limit) {
  Check check;
  check.group = std::move(group);
  check.name = std::move(name);
  check.range = std::move(range);
  check.unit = std::move(unit);
  check.limit = limit;
  return check;
}

/// What + - * / and the like do on the device.
[[nodiscard]] std::vector<Check> arithmetic_checks();
/// Our elementary functions.
[[nodiscard]] std::vector<Check> elementary_checks();
/// What models are made of: reflectances, microfacets, maps.
[[nodiscard]] std::vector<Check> piece_checks();
/// Triangles of emitters as they are seen from a point.
[[nodiscard]] std::vector<Check> seen_triangle_checks();
/// Every BSDF.
[[nodiscard]] std::vector<Check> bsdf_checks();
/// Rays through closed meshes and along axes.
[[nodiscard]] std::vector<Check> leak_checks();
/// Nearest hits.
[[nodiscard]] std::vector<Check> hit_checks();
/// Rays that leave surfaces.
[[nodiscard]] std::vector<Check> surface_checks();
/// Emitters.
[[nodiscard]] std::vector<Check> light_checks();
/// Shapes of images.
[[nodiscard]] std::vector<Check> image_checks();
/// Whole renders.
[[nodiscard]] std::vector<Check> scene_checks();
/// The reference beside the kernels in scenes of the other checks.
[[nodiscard]] std::vector<Check> parity_checks();

}  // namespace facet::extremes
