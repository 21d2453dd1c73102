// The table of provenance, and the commands that are made of it.
#include "image/record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <set>

#include "image/rerun.h"

namespace facet::test {
namespace {

/// A record of which nothing has its default.
RenderRecord full_record() {
  RenderRecord r;
  r.version = "1.2.3";
  r.scene = "/a folder/the scene.xml";
  r.integrator = "path_mis";
  r.sampler = "zsobol";
  r.planned = 64;
  r.sampling = LobeSampling::ndf;
  r.samples = SampleRanges(SampleRange{3, 9});
  r.division = Division{{0, 18}, 3, {0, 2, 5, 9}, 2};
  r.adaptive = true;
  r.seed = 4000000000U;
  r.max_depth = 7;
  r.heuristic = Heuristic::power;
  r.emitter_selection = EmitterSelection::uniform;
  r.area_sampling = AreaSampling::solid_angle;
  r.environment_sampling = EnvironmentSampling::radiance;
  r.emitter_candidates = 3;
  r.masking = Masking::exact;
  r.filter = "tent";
  r.fingerprint = 0x0123456789abcdefU;
  r.backend = "reference";
  r.precision = Precision::double_;
  r.device = "a device";
  r.driver = "a driver";
  r.seconds = 1.5;
  r.stopped_by = StoppedBy::interrupt;
  return r;
}

TEST(Record, survives_a_header) {
  const Metadata header = header_of(full_record());
  const ParsedRecord parsed = parse_record(header);
  EXPECT_TRUE(parsed.missing.empty());
  EXPECT_TRUE(parsed.damaged.empty());
  EXPECT_EQ(header_of(parsed.record), header);
  EXPECT_EQ(header.size(), record_fields().size());
  EXPECT_EQ(*find_metadata(header, "facet.scene"), "the scene.xml") << "no path leaves the machine";
  // A field that the header does not carry would keep its default in the record that was read.
  const Metadata plain = header_of(RenderRecord());
  for (const auto& [key, text] : header) {
    const std::string* other = find_metadata(plain, key);
    EXPECT_TRUE(other == nullptr || *other != text) << key;
  }
}

TEST(Record, has_each_name_once) {
  std::set<std::string> names;
  for (const RecordField& field : record_fields()) {
    EXPECT_TRUE(names.insert(field.key).second) << field.key;
    for (const char* other : {field.json, field.option}) {
      if (other == nullptr) continue;
      EXPECT_TRUE(names.insert(other).second) << other;
    }
  }
}

TEST(Record, tells_what_is_damaged) {
  for (const auto& [key, text] :
       std::vector<std::pair<std::string, std::string>>{{"facet.samples", "9:3"},
                                                        {"facet.spp", "5"},
                                                        {"facet.seed", "-1"},
                                                        {"facet.seed", "4294967296"},
                                                        {"facet.division", "3 parts"},
                                                        {"facet.maxDepth", "-2"},
                                                        {"facet.heuristic", "cutoff"},
                                                        {"facet.emitterSelection", "all"},
                                                        {"facet.masking", "none"},
                                                        {"facet.sampling", ""},
                                                        {"facet.precision", "half"},
                                                        {"facet.fingerprint", "123"},
                                                        {"facet.fingerprint", "0123456789abcdeg"},
                                                        {"facet.seconds", "nan"}}) {
    Metadata header = header_of(full_record());
    for (auto& entry : header) {
      if (entry.first == key) entry.second = text;
    }
    const ParsedRecord parsed = parse_record(header);
    ASSERT_FALSE(parsed.damaged.empty()) << key << ' ' << text;
    EXPECT_EQ(parsed.damaged.back().text, key == "facet.samples" ? "6" : text);
  }
}

TEST(Record, makes_the_command_that_renders_again) {
  RenderRecord full = full_record();
  full.adaptive = false;
  EXPECT_EQ(rerun_command(full, {40, 30}, 5, 6),
            "facet render --pixel=5,6 --resolution=40x30 --backend=reference --precision=double "
            "--integrator=path_mis --max-depth=7 --heuristic=power --emitter-selection=uniform "
            "--area-sampling=solidangle --environment-sampling=radiance --emitter-candidates=3 "
            "--sampler=zsobol --spp=64 "
            "--sampling=ndf "
            "--masking=exact "
            "--sample-range=3:9 --seed=4000000000 "
            "-- '/a folder/the scene.xml'");
  RenderRecord kernels = full;
  kernels.backend = "vulkan";
  kernels.masking.reset();
  const std::string command = rerun_command(kernels, {40, 30}, 5, 6);
  EXPECT_EQ(command.find("--precision"), std::string::npos);
  EXPECT_EQ(command.find("--masking"), std::string::npos);
}

TEST(Record, has_no_command_for_what_no_single_one_renders) {
  EXPECT_EQ(rerun_command(full_record(), {40, 30}, 5, 6), "") << "adaptive";
  RenderRecord even = full_record();
  even.adaptive = false;
  RenderRecord gaps = even;
  gaps.samples.add(SampleRange{20, 30});
  EXPECT_EQ(rerun_command(gaps, {40, 30}, 5, 6), "");
  RenderRecord memory = even;
  memory.scene.clear();
  EXPECT_EQ(rerun_command(memory, {40, 30}, 5, 6), "");
  ParsedRecord damaged = parse_record(header_of(even));
  damaged.damaged.push_back({record_fields().data(), "?"});
  EXPECT_EQ(rerun_command(damaged, {40, 30}, 5, 6), "");
}

TEST(Record, shared_samples_are_seen) {
  RenderRecord other = full_record();
  EXPECT_TRUE(share_samples(full_record(), other));
  other.samples = SampleRanges(SampleRange{9, 12});
  EXPECT_FALSE(share_samples(full_record(), other));
  other = full_record();
  other.seed = 1;
  EXPECT_FALSE(share_samples(full_record(), other));
}

TEST(ShellWord, is_quoted_where_it_must_be) {
  EXPECT_EQ(shell_word("a/b-c_1.xml"), "a/b-c_1.xml");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("it's $HOME"), "'it'\\''s $HOME'");
  // A shell reads them back.
  for (const std::string word :
       {"it's\x1b[31m %d \\033 \n\"$HOME`", "\x7f", "50 %\t\\", "-\x01 a", "\xc2\x9b \xc3\xa9"}) {
    const std::string text = shell_word(word);
    EXPECT_TRUE(std::ranges::none_of(
        text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }));
    const std::string command = "printf %s " + text;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> shell(::popen(command.c_str(), "r"),
                                                                &::pclose);
    std::string back(100, '\0');
    back.resize(std::fread(back.data(), 1, back.size(), shell.get()));
    EXPECT_EQ(back, word);
  }
}

}  // namespace
}  // namespace facet::test
