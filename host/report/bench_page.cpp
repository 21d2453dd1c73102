#include "report/bench_page.h"

#include <nlohmann/json.hpp>

#include "core/text_file.h"
#include "report/page.h"
#include "report/pages/page_text.h"
#include "version.h"

namespace facet::report {

void write_bench_page(const std::string& path, const BenchReport& report) {
  nlohmann::ordered_json data = bench_json(report);
  data["version"] = FACET_VERSION;
  write_text(path, make_page(page_text::bench_html, {page_text::page_css},
                             {page_text::draw_js, page_text::bench_js}, data));
}

}  // namespace facet::report
