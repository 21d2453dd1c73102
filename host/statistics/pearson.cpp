#include "statistics/pearson.h"

#include <algorithm>
#include <cmath>

#include "statistics/hypothesis.h"

namespace facet::statistics {

Pearson::Pearson(std::vector<Count> bins, double least, double forgiven) : least_(least) {
  std::ranges::sort(bins, {}, &Count::expected);
  Count pool;
  for (const Count& bin : bins) {
    if (!(bin.expected > 0)) {
      if (bin.observed <= forgiven) continue;
      impossible_ = true;
      pool.observed += bin.observed;
    } else if (bin.expected < least || (pool.expected > 0 && pool.expected < least)) {
      pool.expected += bin.expected;
      pool.observed += bin.observed;
    } else {
      add_term(bin.observed - bin.expected, bin.expected);
      ++populated_;
    }
  }
  if (pool.expected > 0 || pool.observed > 0)
    add_term(pool.observed - pool.expected, pool.expected);
}

void Pearson::add_rest(const Count& rest, double slack) {
  add_term(std::max(0.0, std::abs(rest.observed - rest.expected) - slack), rest.expected);
}

void Pearson::add_term(double difference, double expected) {
  // What is rarer than the approximation wants counts as if it were not: it then weighs too little,
  // never too much.
  statistic_ += difference * difference / std::max(expected, least_);
  ++terms_;
}

double Pearson::p_value() const {
  return std::isfinite(statistic_) ? chi_squared_survival(statistic_, degrees()) : 0;
}

}  // namespace facet::statistics
