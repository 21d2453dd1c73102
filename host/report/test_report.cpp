#include "report/test_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <sstream>

namespace facet::report {

namespace {

bool is_chi_squared(const nori::TestCase& c) { return c.estimate.samples == 0; }

/// Infinite and undefined figures are null.
nlohmann::ordered_json finite(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

}  // namespace

std::string figures(const nori::TestCase& c) {
  const nori::Verdict& v = c.verdict;
  const std::string statistic =
      is_chi_squared(c)
          ? fmt::format("chi2 = {:.2f} ({:.0f} degrees of freedom)", v.statistic, v.degrees)
          : fmt::format("t = {:.2f} (mean {:.6g}, reference {:.6g})", v.statistic, c.estimate.mean,
                        c.reference);
  return fmt::format("{}, p = {:.3g}", statistic, v.p_value);
}

std::string case_line(const ReportedCase& r) {
  const nori::Verdict& v = r.result.verdict;
  return fmt::format("{}: {}: {}, {}{}{}", r.file, r.result.name, figures(r.result),
                     v.passed ? "passed" : "FAILED", v.note.empty() ? "" : ": ", v.note);
}

std::string test_json(const std::vector<ReportedCase>& cases, const std::string& backend,
                      std::uint32_t seed) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ReportedCase& r : cases) {
    const nori::Verdict& v = r.result.verdict;
    nlohmann::ordered_json one{{"file", r.file},
                               {"line", r.result.where.line},
                               {"case", r.result.name},
                               {"test", is_chi_squared(r.result) ? "chi2test" : "ttest"},
                               {"statistic", finite(v.statistic)},
                               {"degrees", finite(v.degrees)},
                               {"p", finite(v.p_value)},
                               {"passed", v.passed},
                               {"seconds", r.seconds}};
    if (!is_chi_squared(r.result)) {
      one["mean"] = finite(r.result.estimate.mean);
      one["standard_error"] = finite(r.result.estimate.standard_error);
      one["reference"] = r.result.reference;
      one["samples"] = r.result.estimate.samples;
    }
    if (!v.note.empty()) one["note"] = v.note;
    if (!r.picture.empty()) one["picture"] = r.picture;
    list.push_back(one);
  }
  const auto passed = std::count_if(cases.begin(), cases.end(),
                                    [](const auto& r) { return r.result.verdict.passed; });
  const nlohmann::ordered_json json{{"backend", backend},
                                    {"seed", seed},
                                    {"total", cases.size()},
                                    {"passed", passed},
                                    {"cases", list}};
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string test_junit(const std::vector<ReportedCase>& cases) {
  pugi::xml_document document;
  document.append_child(pugi::node_declaration).append_attribute("version") = "1.0";
  pugi::xml_node suites = document.append_child("testsuites");
  std::map<std::string, pugi::xml_node> by_file;
  for (const ReportedCase& r : cases) {
    pugi::xml_node& suite = by_file[r.file];
    if (!suite) {
      suite = suites.append_child("testsuite");
      suite.append_attribute("name") = r.file.c_str();
      suite.append_attribute("tests") = 0;
      suite.append_attribute("failures") = 0;
    }
    const auto count = [&suite](const char* name) {
      suite.attribute(name) = suite.attribute(name).as_int() + 1;
    };
    count("tests");
    pugi::xml_node one = suite.append_child("testcase");
    one.append_attribute("classname") = r.file.c_str();
    one.append_attribute("name") = r.result.name.c_str();
    one.append_attribute("file") = r.file.c_str();
    one.append_attribute("line") = r.result.where.line;
    one.append_attribute("time") = fmt::format("{:.3f}", r.seconds).c_str();
    if (r.result.verdict.passed) continue;
    count("failures");
    pugi::xml_node failure = one.append_child("failure");
    failure.append_attribute("message") = case_line(r).c_str();
    if (!r.picture.empty()) failure.text() = ("picture: " + r.picture).c_str();
  }
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

}  // namespace facet::report
