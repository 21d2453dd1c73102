#pragma once
// What `facet tradeoff` measured as a page that needs nothing else: the plot, the table with a
// command for every point, and images at equal time.
#include <string>

#include "report/tradeoff_report.h"

namespace facet::report {

/// Throws InputError where the file cannot be written.
void write_tradeoff_page(const std::string& path, const TradeoffReport& report);

}  // namespace facet::report
