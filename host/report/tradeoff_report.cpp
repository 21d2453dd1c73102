#include "report/tradeoff_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

namespace facet::report {

namespace {

using namespace facet::tradeoff;
using nlohmann::ordered_json;

/// A relative error as a percentage of three digits.
std::string percent(double relmse) {
  return relmse > 0 ? fmt::format("{:.3g} %", 100 * std::sqrt(relmse)) : "0 %";
}

std::string times(double ratio) { return fmt::format("{:.3g}", ratio); }

std::string interval_text(const Interval& interval) {
  return std::isfinite(interval.high) && interval.low > 0
             ? fmt::format("{:.2g} to {:.2g}", interval.low, interval.high)
             : "unknown";
}

std::string bias_text(const Setting& setting) {
  if (!setting.biased) return "none seen";
  return setting.bias > 0 ? fmt::format("{:.2g} %", 100 * setting.bias) : "too small to see";
}

/// Cells of the table, the heads first.
using Row = std::vector<std::string>;

Row row_of(const Setting& s) {
  const Point& p = s.last();
  const bool on_front = std::ranges::any_of(s.points, &Point::front);
  return {s.name,
          fmt::format("{}", p.samples),
          fmt::format("{:.3f}", p.seconds),
          p.at_reference ? "too small" : percent(p.relmse),
          p.at_reference ? "to measure" : percent(p.relmse_trimmed),
          times(p.expected_ratio),
          times(p.efficiency_ratio),
          interval_text(p.ratio_interval),
          times(p.trimmed_ratio),
          s.slope ? fmt::format("{:.2f}", *s.slope) : "",
          bias_text(s),
          on_front ? "yes" : ""};
}

std::string table_of(const Tradeoff& t) {
  std::vector<Row> rows{{"", "spp", "seconds", "error", "trimmed", "efficiency", "measured", "95 %",
                         "trimmed", "slope", "bias", "front"}};
  for (const std::size_t i : by_efficiency(t)) rows.push_back(row_of(t.settings[i]));
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  std::string text;
  for (const Row& row : rows) {
    text += fmt::format("{:<{}}", row[0], widths[0]);
    for (std::size_t k = 1; k < row.size(); ++k) text += fmt::format("  {:>{}}", row[k], widths[k]);
    while (text.ends_with(' ')) text.pop_back();
    text += '\n';
  }
  return text;
}

std::string reference_text(const Tradeoff& t) {
  const Reference& r = t.reference;
  std::string text = r.file.empty() ? "made by " + r.how : r.file;
  if (r.samples > 0) text += fmt::format(", {} samples a pixel", r.samples);
  text += r.noise.empty() ? ", of unknown error" : ", error " + percent(r.relmse());
  return text;
}

std::string advice_text(const Tradeoff& t, const Advice& a) {
  return fmt::format("{}: about {:.2g} s at {}x{}, with {:.0f} samples a pixel{}",
                     t.settings[a.setting].name, a.seconds, t.own_size.width, t.own_size.height,
                     a.samples, a.measured ? "" : ", more than were measured");
}

std::string error_option(double error) { return fmt::format(" --error {:.6g}%", 100 * error); }

ordered_json json_of(const Interval& interval) {
  // JSON has no number for infinity.
  return {interval.low, std::isfinite(interval.high) ? ordered_json(interval.high) : nullptr};
}

ordered_json point_json(const Tradeoff& t, const Setting& s, const Point& p) {
  return {{"name", s.name},
          {"options", s.options},
          {"spp", p.samples},
          {"seconds", p.seconds},
          {"relmse", p.relmse},
          {"relmse_trimmed", p.relmse_trimmed},
          {"interval95", json_of(p.interval)},
          {"biased", s.biased},
          {"bias", s.bias},
          {"efficiency_ratio", p.efficiency_ratio},
          {"efficiency_ratio_interval95", json_of(p.ratio_interval)},
          {"efficiency_ratio_trimmed", p.trimmed_ratio},
          {"efficiency_ratio_expected", p.expected_ratio},
          {"slope", s.slope ? ordered_json(*s.slope) : nullptr},
          {"front", p.front},
          {"at_reference", p.at_reference},
          {"command", command_of(t, s, p.samples)}};
}

ordered_json advice_json(const Tradeoff& t, const Advice& a, double error) {
  const Setting& s = t.settings[a.setting];
  return {{"name", s.name},
          {"options", s.options},
          {"spp", a.samples},
          {"seconds", a.seconds},
          {"measured", a.measured},
          {"bias", s.bias},
          {"command", command_of(t, s, error_option(error))}};
}

}  // namespace

std::vector<std::size_t> by_efficiency(const Tradeoff& tradeoff) {
  std::vector<std::size_t> order(tradeoff.settings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    const Setting& s = tradeoff.settings[i];
    // Only with the same number of samples are ratios comparable.
    const bool is_full = s.last().samples == tradeoff.settings.front().last().samples;
    return std::pair(is_full, s.last().expected_ratio);
  };
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return key(a) > key(b); });
  return order;
}

std::string advised_command(const TradeoffReport& report) {
  if (!report.wanted_error) return "";
  const auto advice = advise(report.tradeoff, *report.wanted_error);
  if (!advice) return "";
  return command_of(report.tradeoff, report.tradeoff.settings[advice->setting],
                    error_option(*report.wanted_error));
}

std::string text_of(const TradeoffReport& report) {
  const Tradeoff& t = report.tradeoff;
  std::string text =
      fmt::format("{} at {}x{} on {}, {} renders of each point\n", printable(t.scene), t.size.width,
                  t.size.height, t.device, t.seeds);
  if (t.size.width != t.own_size.width || t.size.height != t.own_size.height)
    text += fmt::format(
        "smaller than the scene's {}x{}, to fit the budget: edges weigh more; see --budget and "
        "--resolution\n",
        t.own_size.width, t.own_size.height);
  text += "reference: " + reference_text(t) + "\n\n";
  text += table_of(t);
  const Setting& best = t.settings[t.best];
  text += fmt::format(
      "\nerror: root of relMSE; trimmed: without the 0.1 % worst pixels; efficiency: 1 / (relMSE x "
      "seconds), the default's is 1, as expected where a few bright pixels make the error, and as "
      "measured\nbest: {}, {} times the default\n",
      best.name, times(best.last().expected_ratio));
  if (!report.wanted_error) return text + "  " + command_of(t, best, "") + '\n';
  const auto advice = advise(t, *report.wanted_error);
  if (!advice) return text;
  text += fmt::format("soonest at an error of {:.4g} %: {}\n", 100 * *report.wanted_error,
                      advice_text(t, *advice));
  text += "  " + advised_command(report) + '\n';
  if (const auto biased = advise_biased(t, *report.wanted_error, *advice)) {
    const Setting& s = t.settings[biased->setting];
    text += fmt::format("sooner with a bias of {:.2g} %, which --error does not see: {}\n  {}\n",
                        100 * s.bias, advice_text(t, *biased),
                        command_of(t, s, fmt::format(" --spp {:.0f}", biased->samples)));
  }
  return text;
}

ordered_json tradeoff_json(const TradeoffReport& report) {
  const Tradeoff& t = report.tradeoff;
  const Setting& best = t.settings[t.best];
  ordered_json points = ordered_json::array();
  for (const std::size_t i : by_efficiency(t)) {
    for (const Point& p : t.settings[i].points) points.push_back(point_json(t, t.settings[i], p));
  }
  ordered_json json{{"scene", t.scene},
                    {"device", t.device},
                    {"driver", t.driver},
                    {"width", t.size.width},
                    {"height", t.size.height},
                    {"own_width", t.own_size.width},
                    {"own_height", t.own_size.height},
                    {"seeds", t.seeds},
                    {"complete", !t.interrupted},
                    {"startup_seconds", t.startup_seconds},
                    {"reference",
                     {{"file", t.reference.file},
                      {"how", t.reference.how},
                      {"spp", t.reference.samples},
                      {"known", !t.reference.noise.empty()},
                      {"relative_error", std::sqrt(t.reference.relmse())},
                      {"text", reference_text(t)}}},
                    {"points", points},
                    {"best",
                     {{"name", best.name},
                      {"options", best.options},
                      {"efficiency_ratio", best.last().efficiency_ratio},
                      {"efficiency_ratio_expected", best.last().expected_ratio},
                      {"command", command_of(t, best, "")}}}};
  if (!report.wanted_error) return json;
  json["wanted_error"] = *report.wanted_error;
  if (const auto advice = advise(t, *report.wanted_error)) {
    json["recommendation"] = advice_json(t, *advice, *report.wanted_error);
    if (const auto biased = advise_biased(t, *report.wanted_error, *advice))
      json["biased_recommendation"] = advice_json(t, *biased, *report.wanted_error);
  }
  return json;
}

}  // namespace facet::report
