#pragma once
// What `facet test` found: lines for people, JSON, and JUnit XML for CI machines.
#include <string>
#include <vector>

#include "nori/nori_tests.h"

namespace facet::report {

/// A case of a file, with what it took.
struct ReportedCase {
  std::string file;
  nori::TestCase result;
  std::string picture;  ///< where one was written
  double seconds = 0;
};

/// "file: case: t = 0.7, p = 0.48, passed"
[[nodiscard]] std::string case_line(const ReportedCase& reported);

/// "t = 0.7 (mean 0.5, reference 0.5), p = 0.48" or "chi2 = 180.1 (175 degrees of freedom), p =
/// 0.38".
[[nodiscard]] std::string figures(const nori::TestCase& result);

/// {"backend", "seed", "passed", "cases": [...]}
[[nodiscard]] std::string test_json(const std::vector<ReportedCase>& cases,
                                    const std::string& backend, std::uint32_t seed);

/// A <testsuites> with one <testsuite> a file.
[[nodiscard]] std::string test_junit(const std::vector<ReportedCase>& cases);

}  // namespace facet::report
