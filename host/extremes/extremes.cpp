#include "extremes/extremes.h"

#include "core/clock.h"
#include "extremes/bench.h"

namespace facet::extremes {

std::vector<Check> all_checks() {
  std::vector<Check> checks;
  for (std::vector<Check>& some :
       std::array{arithmetic_checks(), elementary_checks(), piece_checks(), seen_triangle_checks(),
                  bsdf_checks(), leak_checks(), hit_checks(), surface_checks(), light_checks(),
                  image_checks(), scene_checks(), parity_checks()})
    checks.insert(checks.end(), std::move_iterator(some.begin()), std::move_iterator(some.end()));
  return checks;
}

Table measure(KernelBackend& backend, const std::vector<Check>& checks, bool quick,
              const Callback& callback, const std::function<void(const Table&)>& finished) {
  Table table{backend.name(), backend.driver(), quick, false, {}};
  const Check* current = nullptr;
  Bench bench(backend, quick, [&](double done) { return callback(*current, done); });
  try {
    for (const Check& check : checks) {
      current = &check;
      if (!callback(check, 0)) throw Interrupted();
      const auto start = std::chrono::steady_clock::now();
      Row row{check, check.measure(bench), 0};
      row.seconds = seconds_since(start);
      table.rows.push_back(std::move(row));
      table.complete = table.rows.size() == checks.size();
      finished(table);
    }
  } catch (const Interrupted&) {
    // The rows until then are the table.
  }
  return table;
}

}  // namespace facet::extremes
