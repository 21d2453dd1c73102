// Every plugin has a manual.
#include "scene/manuals.h"

#include <gtest/gtest.h>

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

TEST(Manuals, begin_with_one_line) {
  for (const Manual& m : manuals()) {
    EXPECT_GT(m.summary.size(), 10U) << m.names;
    EXPECT_LT(m.summary.size(), 160U) << m.names;
    EXPECT_EQ(m.summary.find('\n'), std::string_view::npos) << m.names;
    EXPECT_EQ(m.text.substr(0, 10), m.summary.substr(0, 10)) << m.names;
    EXPECT_EQ(m.text.find("Record:"), std::string_view::npos) << m.names;
  }
}

}  // namespace

}  // namespace facet
