#pragma once
// What `facet compare` found, for CI machines: a job's summary in Markdown, and JUnit XML.
#include <string>

#include "compare/comparison.h"

namespace facet::report {

/// A verdict, the table of figures, and where in the image the errors are, as squares of colour,
/// since hosts of CI show no images in summaries.
[[nodiscard]] std::string comparison_markdown(const CompareOptions& options,
                                              const Comparison& comparison);

/// A <testsuites> with one <testcase> a threshold; without any, one that holds.
[[nodiscard]] std::string comparison_junit(const CompareOptions& options,
                                           const Comparison& comparison);

}  // namespace facet::report
