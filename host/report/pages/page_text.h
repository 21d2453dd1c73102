#pragma once
// The files of this folder, embedded.
#include <string_view>

namespace facet::report::page_text {

extern const std::string_view bench_html;
extern const std::string_view bench_js;
extern const std::string_view compare_html;
extern const std::string_view compare_css;
extern const std::string_view compare_js;
extern const std::string_view draw_js;
extern const std::string_view extremes_html;
extern const std::string_view extremes_js;
extern const std::string_view frame_html;
extern const std::string_view images_js;
extern const std::string_view page_css;
extern const std::string_view tradeoff_html;
extern const std::string_view tradeoff_css;
extern const std::string_view tradeoff_js;

}  // namespace facet::report::page_text
