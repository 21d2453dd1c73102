// Checkpoint files: every bit comes back, and damage to any byte is noticed.
#include "parts/checkpoint.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "image/files.h"
#include "image/film.h"
#include "image/film_words.h"
#include "image/record.h"
#include "parts/checksum.h"
#include "parts/merge.h"
#include "support/input.h"
#include "support/states.h"

namespace facet {

namespace {

using test::expect_message;
using test::input_error_of;

constexpr int width = 5;
constexpr int height = 4;
constexpr auto pixels = static_cast<std::size_t>(width) * height;

/// Words of every kind: numbers, infinities, denormal numbers, NaN of both kinds.
WordPlane make_words(std::uint32_t seed) {
  std::mt19937 random(seed);
  WordPlane plane(pixels);
  for (std::uint32_t& word : plane) word = static_cast<std::uint32_t>(random());
  plane[0] = 0x7f800001U;
  plane[1] = 0xffc00000U;
  plane[2] = 1;
  plane[3] = 0x7f800000U;
  return plane;
}

RenderState make_state() {
  RenderState state = test::make_state(width, height, {3, 2, 20, 10}, 40);
  SamplingState& plan = state.plan;
  plan.done = 32;
  plan.more = 32;
  plan.sample = 8;
  plan.length = 2;
  plan.pixel = 7;
  plan.wanted = 0x1.23456789abcdep+5;
  state.image = {make_words(1), make_words(2)};
  state.trial = {make_words(3)};
  state.most = 1000;
  state.error = 0.1 / 3;
  state.statistics.closest_rays = 1ULL << 60U;
  state.statistics.render_seconds = 1.0 / 3;
  return state;
}

class CheckpointTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string write(const RenderState& state) const {
    write_exr(folder_.file("ck.exr"), make_checkpoint(state), ExrCompression::uncompressed);
    return folder_.file("ck.exr").string();
  }
  test::TemporaryFolder folder_;
};

void expect_same(const RenderState& a, const RenderState& b) {
  EXPECT_EQ(a.plan, b.plan);
  EXPECT_EQ(a.image, b.image);
  EXPECT_EQ(a.trial, b.trial);
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.most, b.most);
  EXPECT_EQ(a.timed, b.timed);
  EXPECT_EQ(a.error, b.error);
  EXPECT_EQ(a.probes, b.probes);
  EXPECT_EQ(a.statistics.closest_rays, b.statistics.closest_rays);
  EXPECT_EQ(a.statistics.render_seconds, b.statistics.render_seconds);
  EXPECT_EQ(header_of(a.film.record), header_of(b.film.record));
}

TEST_F(CheckpointTest, EveryBitComesBack) {
  RenderState state = make_state();
  expect_same(read_checkpoint(write(state)), state);
  state.film.record.adaptive = true;
  state.plan.counts = make_words(4);
  for (std::size_t i = 0; i < pixels; ++i)
    state.plan.wishes.push_back(std::exp(static_cast<double>(i) / 3));
  state.plan.first_half = state.film.pixels;
  state.plan.stage = SamplingState::Stage::second_half_of_pilot;
  state.timed = true;
  state.error.reset();
  expect_same(read_checkpoint(write(state)), state);
}

TEST_F(CheckpointTest, IsAPart) {
  const RenderState state = make_state();
  const PartSet set = open_parts({write(state)});
  EXPECT_EQ(set.samples().text(), "0:40");
  const Film film = merge(set);
  EXPECT_EQ(film.window.x, 3);
  for (std::size_t i = 0; i < pixels; ++i) {
    EXPECT_NEAR(film.pixels[i].values[0], state.film.pixels[i].values[0], 1e-12);
    EXPECT_EQ(film.pixels[i].samples, 40U);
  }
}

TEST_F(CheckpointTest, AmidASampleItIsNotMerged) {
  RenderState state = make_state();
  state.film.record.stopped_by = StoppedBy::interrupt;
  const std::string file = write(state);
  expect_message(input_error_of([&] { return open_parts({file}); }), file, {"amid a sample"});
}

// Every seventh byte of the file: it is refused, or what it says is the same.
TEST_F(CheckpointTest, DamageIsNoticed) {
  const RenderState state = make_state();
  const std::string file = write(state);
  const std::string good = folder_.read("ck.exr");
  std::size_t refused = 0;
  for (std::size_t i = 0; i < good.size(); i += 7) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ (1 << i % 8));
    folder_.write("bad.exr", bad);
    try {
      expect_same(read_checkpoint(folder_.file("bad.exr").string()), state);
      if (::testing::Test::HasFailure()) FAIL() << "byte " << i;
    } catch (const Error& error) {
      ASSERT_EQ(error.kind(), ErrorKind::input);
      ++refused;
    }
  }
  EXPECT_GT(refused, good.size() / 14);
  for (std::size_t size = 0; size < good.size(); size += 397) {
    folder_.write("bad.exr", good.substr(0, size));
    EXPECT_THROW((void)read_checkpoint(folder_.file("bad.exr").string()), Error) << size;
  }
}

// Whoever writes a bad file can give it a good checksum.
TEST_F(CheckpointTest, PlanesThatMakeNoNumbersAreRefused) {
  RenderState state = make_state();
  state.plan.wishes.assign(pixels, 1.0);
  Image image = make_checkpoint(state);
  Image fewer(width, height, [&] {
    std::vector<std::string> channels = image.channels();
    std::erase(channels, "state.wishes.01");
    return channels;
  }());
  fewer.window = image.window;
  fewer.metadata = image.metadata;
  add_checksum(fewer);
  write_exr(folder_.file("bad.exr"), fewer);
  const std::string file = folder_.file("bad.exr").string();
  expect_message(input_error_of([&] { return read_checkpoint(file); }), file, {"damaged"});
}

TEST_F(CheckpointTest, ContinuesOnlyTheSameRender) {
  const RenderState own = make_state();
  check_continues(own, "ck.exr", own);
  const auto expect_refused = [&](const auto& change, std::initializer_list<const char*> words) {
    RenderState saved = make_state();
    change(saved);
    expect_message(input_error_of([&] { return check_continues(saved, "ck.exr", own), 0; }),
                   "ck.exr", words);
  };
  expect_refused([](RenderState& s) { s.film.record.version = "1.2.4"; },
                 {"version of facet is 1.2.4"});
  expect_refused([](RenderState& s) { s.film.record.seed = 9; }, {"seed is 9", "0"});
  expect_refused(
      [](RenderState& s) { s.film.record.scene = "b.xml", s.film.record.fingerprint = 1; },
      {"scene is b.xml"});
  expect_refused([](RenderState& s) { s.film.record.device = "NVIDIA H200"; },
                 {"kind of device is NVIDIA H200", "llvmpipe"});
  expect_refused([](RenderState& s) { s.most = 7; }, {"range of samples is 0:7", "0:1000"});
  expect_refused([](RenderState& s) { s.probes = true; }, {"second estimate"});
  expect_refused([](RenderState& s) { s.film.has_squares = false; }, {"squares"});
  RenderState other_driver = make_state();
  other_driver.film.record.device = "llvmpipe (LLVM 19, 256 bits)";
  check_continues(other_driver, "ck.exr", own);
}

TEST(Checksum, DependsOnWhatMakesAPart) {
  Image image(2, 1, {"R", "sum.R", "state.image.00", "error.R"});
  image.metadata = {{"facet.seed", "3"}, {"owner", "me"}};
  add_checksum(image);
  const std::string sum = checksum(image);
  EXPECT_EQ(*find_metadata(image.metadata, checksum_key), sum);
  check_checksum(image, "a.exr");
  Image other = image;
  other.at(0, 0, 0) = 1;
  other.at(0, 0, 3) = 1;
  other.metadata[1].second = "you";
  EXPECT_EQ(checksum(other), sum);
  for (const int channel : {1, 2}) {
    other = image;
    other.at(1, 0, channel) = 0x1p-149F;
    EXPECT_NE(checksum(other), sum);
  }
  other = image;
  other.metadata[0].second = "4";
  expect_message(input_error_of([&] { return check_checksum(other, "a.exr"), 0; }), "a.exr",
                 {"damaged", "checksum", sum.c_str()});
}

}  // namespace

}  // namespace facet
