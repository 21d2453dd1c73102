// Record offsets in the compiled kernels are those of C++.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "shared/records.h"
#include "support/spirv.h"

namespace facet {
namespace {

constexpr std::uint32_t op_name = 5;
constexpr std::uint32_t op_member_name = 6;
constexpr std::uint32_t op_member_decorate = 72;
constexpr std::uint32_t decoration_offset = 35;

std::string text_of(std::span<const std::uint32_t> words) {
  return reinterpret_cast<const char*>(words.data());
}

using Offsets = std::map<std::string, std::size_t>;

/// Offsets of the members of every struct with a layout, by name; the same name always has the same
/// offsets.
std::map<std::string, Offsets> reflect(std::span<const std::uint32_t> words) {
  std::map<std::uint32_t, std::string> names;
  std::map<std::uint32_t, std::map<std::uint32_t, std::string>> members;
  std::map<std::string, Offsets> structs;
  test::for_each_instruction(words, [&](std::uint32_t opcode, std::span<const std::uint32_t> o) {
    if (opcode == op_name) names[o[0]] = text_of(o.subspan(1));
    if (opcode == op_member_name) members[o[0]][o[1]] = text_of(o.subspan(2));
    if (opcode == op_member_decorate && o[2] == decoration_offset)
      structs[names[o[0]]][members[o[0]][o[1]]] = o[3];
  });
  return structs;
}

#define FACET_OFFSET(Type, member) \
  { #member, offsetof(shared::Type, member) }

const std::map<std::string, Offsets>& expected_offsets() {
  static const std::map<std::string, Offsets> offsets{
      {"FrameRecord",
       {FACET_OFFSET(FrameRecord, camera_origin),
        FACET_OFFSET(FrameRecord, camera_corner),
        FACET_OFFSET(FrameRecord, camera_dx),
        FACET_OFFSET(FrameRecord, camera_dy),
        FACET_OFFSET(FrameRecord, width),
        FACET_OFFSET(FrameRecord, height),
        FACET_OFFSET(FrameRecord, crop_x),
        FACET_OFFSET(FrameRecord, crop_y),
        FACET_OFFSET(FrameRecord, crop_width),
        FACET_OFFSET(FrameRecord, crop_height),
        FACET_OFFSET(FrameRecord, max_depth),
        FACET_OFFSET(FrameRecord, emitter_count),
        FACET_OFFSET(FrameRecord, environment_emitter),
        FACET_OFFSET(FrameRecord, environment_width),
        FACET_OFFSET(FrameRecord, environment_height),
        FACET_OFFSET(FrameRecord, filter_intervals),
        FACET_OFFSET(FrameRecord, filter_crossing),
        FACET_OFFSET(FrameRecord, filter_scale),
        FACET_OFFSET(FrameRecord, square_scale),
        FACET_OFFSET(FrameRecord, simple_position),
        FACET_OFFSET(FrameRecord, simple_energy),
        FACET_OFFSET(FrameRecord, environment_irradiance)}},
      {"RayRecord", {FACET_OFFSET(RayRecord, origin), FACET_OFFSET(RayRecord, direction)}},
      {"HitRecord",
       {FACET_OFFSET(HitRecord, t), FACET_OFFSET(HitRecord, triangle), FACET_OFFSET(HitRecord, b1),
        FACET_OFFSET(HitRecord, b2)}},
      {"PathRecord", {FACET_OFFSET(PathRecord, throughput), FACET_OFFSET(PathRecord, radiance)}},
      {"FilmRecord",
       {FACET_OFFSET(FilmRecord, hi_r), FACET_OFFSET(FilmRecord, hi_g),
        FACET_OFFSET(FilmRecord, hi_b), FACET_OFFSET(FilmRecord, samples),
        FACET_OFFSET(FilmRecord, lo_r), FACET_OFFSET(FilmRecord, lo_g),
        FACET_OFFSET(FilmRecord, lo_b), FACET_OFFSET(FilmRecord, nonzero)}},
      {"EvaluationRecord",
       {FACET_OFFSET(EvaluationRecord, wo), FACET_OFFSET(EvaluationRecord, count),
        FACET_OFFSET(EvaluationRecord, first_sample), FACET_OFFSET(EvaluationRecord, seed),
        FACET_OFFSET(EvaluationRecord, given)}},
      {"QueryRecord", {FACET_OFFSET(QueryRecord, first), FACET_OFFSET(QueryRecord, second)}},
      {"PassConstants",
       {FACET_OFFSET(PassConstants, first_pixel), FACET_OFFSET(PassConstants, pixel_count),
        FACET_OFFSET(PassConstants, first_sample), FACET_OFFSET(PassConstants, sample_count),
        FACET_OFFSET(PassConstants, bounce), FACET_OFFSET(PassConstants, queue),
        FACET_OFFSET(PassConstants, stride), FACET_OFFSET(PassConstants, film_first),
        FACET_OFFSET(PassConstants, film_begin), FACET_OFFSET(PassConstants, film_end),
        FACET_OFFSET(PassConstants, emitter), FACET_OFFSET(PassConstants, seed)}},
  };
  return offsets;
}

TEST(SharedLayout, offsets_in_the_kernels_are_those_of_cpp) {
  std::set<std::string> seen;
  test::for_each_kernel([&](const std::string& kernel, std::span<const std::uint32_t> words) {
    for (const auto& [name, offsets] : reflect(words)) {
      const auto expected = expected_offsets().find(name);
      if (expected == expected_offsets().end()) continue;
      seen.insert(name);
      for (const auto& [member, offset] : expected->second) {
        ASSERT_TRUE(offsets.contains(member)) << kernel << ": " << name << "." << member;
        EXPECT_EQ(offsets.at(member), offset) << kernel << ": " << name << "." << member;
      }
    }
  });
  EXPECT_EQ(seen.size(), expected_offsets().size()) << "some record was found in no kernel";
}

}  // namespace
}  // namespace facet
