#include "report/tradeoff_page.h"

#include <nlohmann/json.hpp>

#include "compare/metrics.h"
#include "core/text_file.h"
#include "report/packed_image.h"
#include "report/page.h"
#include "report/pages/page_text.h"
#include "version.h"

namespace facet::report {

namespace {

/// Beside the report of --json: images in the default's time, the reference the first.
nlohmann::ordered_json page_data(const TradeoffReport& report) {
  const tradeoff::Tradeoff& t = report.tradeoff;
  nlohmann::ordered_json data = tradeoff_json(report);
  data["version"] = FACET_VERSION;
  data["image_width"] = t.reference.image.width();
  data["image_height"] = t.reference.image.height();
  data["epsilon"] = measure_errors(t.reference.image, t.reference.image, 1).epsilon();
  std::vector<const Image*> images{&t.reference.image};
  for (const tradeoff::Setting& s : t.settings) {
    if (s.picture) images.push_back(&s.picture->image);
  }
  const float scale = half_scale(images);
  data["scale"] = scale;
  data["reference"]["pixels"] = packed_halves(t.reference.image, scale);
  data["pictures"] = nlohmann::ordered_json::array();
  for (const std::size_t i : by_efficiency(t)) {
    const tradeoff::Setting& s = t.settings[i];
    if (!s.picture) continue;
    data["pictures"].push_back({{"name", s.name},
                                {"spp", s.picture->samples},
                                {"seconds", s.picture->seconds},
                                {"relmse", s.picture->error.relmse},
                                {"pixels", packed_halves(s.picture->image, scale)},
                                {"command", command_of(t, s, s.picture->samples)}});
  }
  return data;
}

}  // namespace

void write_tradeoff_page(const std::string& path, const TradeoffReport& report) {
  write_text(path,
             make_page(page_text::tradeoff_html, {page_text::page_css, page_text::tradeoff_css},
                       {page_text::draw_js, page_text::images_js, page_text::tradeoff_js},
                       page_data(report)));
}

}  // namespace facet::report
