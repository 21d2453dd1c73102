#pragma once
// What `facet bench` measured as a page that needs nothing else: plots, and every figure in tables.
#include <string>

#include "report/bench_report.h"

namespace facet::report {

/// Throws InputError where the file cannot be written.
void write_bench_page(const std::string& path, const BenchReport& report);

}  // namespace facet::report
