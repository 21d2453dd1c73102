// Every plugin has a manual.
#include "scene/manuals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/text.h"
#include "scene/plugins.h"

namespace facet {

namespace {

TEST(Manuals, every_plugin_has_one_of_its_kind) {
  for (const PluginInfo& plugin : plugins()) {
    int count = 0;
    for (const Manual& m : manuals())
      count += m.kind == plugin.tag && m.is_about(plugin.type) ? 1 : 0;
    EXPECT_EQ(count, 1) << plugin.tag << ' ' << plugin.type;
  }
}

TEST(Manuals, every_manual_is_about_plugins) {
  std::set<std::string_view> types;
  for (const PluginInfo& plugin : plugins()) types.insert(plugin.type);
  for (const Manual& m : manuals()) {
    EXPECT_FALSE(split_list(m.names).empty());
    for (const std::string_view name : split_list(m.names))
      EXPECT_TRUE(types.contains(name)) << name;
  }
}

/// Names of the parameters.
std::vector<std::string> names_of(const PluginInfo& plugin) {
  std::vector<std::string> names;
  for (const ParameterInfo& p : plugin.parameters) names.push_back(p.name);
  return names;
}

TEST(Manuals, tell_every_parameter_of_every_plugin_they_are_about) {
  for (const PluginInfo& plugin : plugins()) {
    for (const Manual& m : manuals()) {
      if (m.kind != plugin.tag || !m.is_about(plugin.type)) continue;
      for (const std::string& name : names_of(plugin))
        EXPECT_NE(full_text(m).find("\n| " + name + ' '), std::string::npos)
            << plugin.type << ' ' << name;
    }
  }
}

TEST(Manuals, say_types_ranges_and_defaults) {
  const auto text = [](std::string_view name) {
    const auto list = manuals();
    return full_text(
        *std::find_if(list.begin(), list.end(), [&](const Manual& m) { return m.is_about(name); }));
  };
  const auto expect_line = [&](std::string_view plugin, const std::string& line) {
    std::string squeezed;
    for (const char c : text(plugin)) {
      if (c != ' ' || squeezed.empty() || squeezed.back() != ' ') squeezed += c;
    }
    EXPECT_NE(squeezed.find("\n| " + line), std::string::npos) << squeezed;
  };
  expect_line("fresnelblend", "Rd | colour or texture, 0 to 1 | 0.5 | ");
  expect_line("fresnelblend", "masking | string, `rational`, `exact` | rational | ");
  expect_line("microfacet", "alpha | number, 0.0001 to 1 | 0.1 | ");
  expect_line("dielectric", "extIOR | number, 0.001 to 1000 | 1.000277 | ");
  expect_line("roughconductor", "multiscatter | boolean | false | ");
  expect_line("pointlight", "position | point | 0, 100, 0 | ");
  expect_line("perspective", "toWorld | transform | identity | ");
  expect_line("textmap", "filename | file | | ");
  expect_line("ttest", "significanceLevel | number, more than 0, less than 1 | 0.01 | ");
}

TEST(Manuals, begin_with_one_line) {
  for (const Manual& m : manuals()) {
    EXPECT_GT(m.summary.size(), 10U) << m.names;
    EXPECT_LT(m.summary.size(), 160U) << m.names;
    EXPECT_EQ(m.summary.find('\n'), std::string_view::npos) << m.names;
    EXPECT_EQ(m.opening.substr(0, 10), m.summary.substr(0, 10)) << m.names;
  }
}

}  // namespace

}  // namespace facet
