#pragma once
// Pages: static HTML whose script draws the JSON that is embedded in it.
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

namespace facet::report {

/// A page whose body (report/pages) is `body`, with its style sheets, its scripts, which share one
/// scope, and its data. Bytes of the data's strings that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string make_page(std::string_view body,
                                    std::initializer_list<std::string_view> styles,
                                    std::initializer_list<std::string_view> scripts,
                                    const nlohmann::ordered_json& data);

[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace facet::report
