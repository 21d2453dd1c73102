#pragma once
// The table of extremes as data: what is checked, and what was found.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace facet::extremes {

class Bench;

/// What a check has measured.
struct Finding {
  std::uint64_t inputs = 0;
  double worst = 0;  ///< infinite where something that must not be has been found
  std::string at;    ///< the input that made it, as one can type it in again
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

/// What + - * / and the like do on the device.
[[nodiscard]] std::vector<Check> arithmetic_checks();
/// Our elementary functions.
[[nodiscard]] std::vector<Check> elementary_checks();
/// What models are made of: reflectances, microfacets, maps.
[[nodiscard]] std::vector<Check> piece_checks();
/// Every BSDF.
[[nodiscard]] std::vector<Check> bsdf_checks();
/// Whole renders.
[[nodiscard]] std::vector<Check> scene_checks();

}  // namespace facet::extremes
