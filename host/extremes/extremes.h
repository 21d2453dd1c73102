#pragma once
// Numbers at the edge: the table that `facet extremes` prints.
#include <functional>
#include <optional>

#include "extremes/check.h"
#include "render/kernel_backend.h"

namespace facet::extremes {

/// A check with what it found.
struct Row {
  Check check;
  Finding finding;
  double seconds = 0;

  [[nodiscard]] bool holds() const { return finding.worst <= check.limit; }
  /// Neither holds nor is argued.
  [[nodiscard]] bool fails() const { return !holds() && check.argued.empty(); }
};

struct Table {
  std::string device;
  std::string driver;
  bool quick = false;
  bool complete = false;  ///< every check asked for has its row
  std::vector<Row> rows;
};

/// All checks, in the order of the table.
[[nodiscard]] std::vector<Check> all_checks();

/// Told the name of each row before it is measured, and the share of it that is done; false ends
/// the measurement.
using Callback = std::function<bool(const Check& check, double done)>;

/// Measures the rows on a backend's device. After each row, `finished` is called with the table so
/// far. quick: a sample of the inputs, edges included. Throws DeviceError.
[[nodiscard]] Table measure(KernelBackend& backend, const std::vector<Check>& checks, bool quick,
                            const Callback& callback,
                            const std::function<void(const Table&)>& finished);

}  // namespace facet::extremes
