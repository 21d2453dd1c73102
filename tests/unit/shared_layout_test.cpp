// The compiled kernels themselves: record offsets as in C++, every float operation decorated.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "render/kernels.h"
#include "shared/records.h"

namespace facet {
namespace {

constexpr Kernel kernels[] = {Kernel::generate, Kernel::extend,   Kernel::shade,
                              Kernel::shadow,   Kernel::schedule, Kernel::film};

constexpr std::uint32_t op_name = 5;
constexpr std::uint32_t op_member_name = 6;
constexpr std::uint32_t op_decorate = 71;
constexpr std::uint32_t op_member_decorate = 72;
constexpr std::uint32_t decoration_offset = 35;
constexpr std::uint32_t decoration_no_contraction = 42;

/// Calls body(opcode, operands) for every instruction.
template <typename Body>
void for_each_instruction(std::span<const std::uint32_t> words, const Body& body) {
  for (std::size_t i = 5; i < words.size(); i += words[i] >> 16U) {
    body(words[i] & 0xffffU, words.subspan(i + 1, (words[i] >> 16U) - 1));
  }
}

std::string text_of(std::span<const std::uint32_t> words) {
  return reinterpret_cast<const char*>(words.data());
}

using Offsets = std::map<std::string, std::size_t>;

/// Offsets of the members of every struct with a layout, by name; the same name always has the same offsets.
std::map<std::string, Offsets> reflect(std::span<const std::uint32_t> words) {
  std::map<std::uint32_t, std::string> names;
  std::map<std::uint32_t, std::map<std::uint32_t, std::string>> members;
  std::map<std::string, Offsets> structs;
  for_each_instruction(words, [&](std::uint32_t opcode, std::span<const std::uint32_t> o) {
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
      {"MeshRecord", {FACET_OFFSET(MeshRecord, bsdf), FACET_OFFSET(MeshRecord, emitter)}},
      {"BsdfRecord",
       {FACET_OFFSET(BsdfRecord, type), FACET_OFFSET(BsdfRecord, a), FACET_OFFSET(BsdfRecord, b)}},
      {"EmitterRecord",
       {FACET_OFFSET(EmitterRecord, radiance), FACET_OFFSET(EmitterRecord, type),
        FACET_OFFSET(EmitterRecord, cumulative), FACET_OFFSET(EmitterRecord, first_triangle),
        FACET_OFFSET(EmitterRecord, triangle_count), FACET_OFFSET(EmitterRecord, probability)}},
      {"EmitterTriangle",
       {FACET_OFFSET(EmitterTriangle, cumulative), FACET_OFFSET(EmitterTriangle, triangle)}},
      {"EnvironmentRow",
       {FACET_OFFSET(EnvironmentRow, cumulative), FACET_OFFSET(EnvironmentRow, y_begin),
        FACET_OFFSET(EnvironmentRow, y_end)}},
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
        FACET_OFFSET(FrameRecord, seed),
        FACET_OFFSET(FrameRecord, max_depth),
        FACET_OFFSET(FrameRecord, emitter_count),
        FACET_OFFSET(FrameRecord, environment_emitter),
        FACET_OFFSET(FrameRecord, environment_width),
        FACET_OFFSET(FrameRecord, environment_height),
        FACET_OFFSET(FrameRecord, filter_intervals),
        FACET_OFFSET(FrameRecord, filter_crossing),
        FACET_OFFSET(FrameRecord, filter_scale),
        FACET_OFFSET(FrameRecord, square_scale)}},
      {"RayRecord", {FACET_OFFSET(RayRecord, origin), FACET_OFFSET(RayRecord, direction)}},
      {"HitRecord",
       {FACET_OFFSET(HitRecord, t), FACET_OFFSET(HitRecord, triangle), FACET_OFFSET(HitRecord, b1),
        FACET_OFFSET(HitRecord, b2)}},
      {"PathRecord", {FACET_OFFSET(PathRecord, throughput), FACET_OFFSET(PathRecord, radiance)}},
      {"ShadowRayRecord",
       {FACET_OFFSET(ShadowRayRecord, origin), FACET_OFFSET(ShadowRayRecord, direction),
        FACET_OFFSET(ShadowRayRecord, contribution_r), FACET_OFFSET(ShadowRayRecord, contribution_g),
        FACET_OFFSET(ShadowRayRecord, contribution_b), FACET_OFFSET(ShadowRayRecord, slot)}},
      {"FilmRecord",
       {FACET_OFFSET(FilmRecord, hi_r), FACET_OFFSET(FilmRecord, hi_g), FACET_OFFSET(FilmRecord, hi_b),
        FACET_OFFSET(FilmRecord, samples), FACET_OFFSET(FilmRecord, lo_r), FACET_OFFSET(FilmRecord, lo_g),
        FACET_OFFSET(FilmRecord, lo_b), FACET_OFFSET(FilmRecord, nonzero)}},
      {"PassConstants",
       {FACET_OFFSET(PassConstants, first_pixel), FACET_OFFSET(PassConstants, pixel_count),
        FACET_OFFSET(PassConstants, first_sample), FACET_OFFSET(PassConstants, sample_count),
        FACET_OFFSET(PassConstants, bounce), FACET_OFFSET(PassConstants, queue),
        FACET_OFFSET(PassConstants, stride), FACET_OFFSET(PassConstants, stage),
        FACET_OFFSET(PassConstants, film_first), FACET_OFFSET(PassConstants, film_begin),
        FACET_OFFSET(PassConstants, film_end)}},
  };
  return offsets;
}

TEST(SharedLayout, offsets_in_the_kernels_are_those_of_cpp) {
  std::set<std::string> seen;
  for (const Kernel kernel : kernels) {
    for (const GeometryFetch fetch : {GeometryFetch::texel_buffer, GeometryFetch::storage_buffer}) {
      for (const auto& [name, offsets] : reflect(kernel_code(kernel, fetch))) {
        const auto expected = expected_offsets().find(name);
        if (expected == expected_offsets().end()) continue;
        seen.insert(name);
        for (const auto& [member, offset] : expected->second) {
          ASSERT_TRUE(offsets.contains(member)) << kernel_name(kernel) << ": " << name << "." << member;
          EXPECT_EQ(offsets.at(member), offset) << kernel_name(kernel) << ": " << name << "." << member;
        }
      }
    }
  }
  EXPECT_EQ(seen.size(), expected_offsets().size()) << "some record was found in no kernel";
}

TEST(SharedLayout, every_float_operation_is_decorated) {
  // FNegate, FAdd, FSub, FMul, FDiv, FRem, FMod, vector and matrix products
  const std::set<std::uint32_t> arithmetic{127, 129, 131, 133, 136, 140, 141,
                                           142, 143, 144, 145, 146, 147, 148};
  for (const Kernel kernel : kernels) {
    for (const GeometryFetch fetch : {GeometryFetch::texel_buffer, GeometryFetch::storage_buffer}) {
      std::set<std::uint32_t> decorated;
      std::set<std::uint32_t> operations;
      for_each_instruction(kernel_code(kernel, fetch),
                           [&](std::uint32_t opcode, std::span<const std::uint32_t> o) {
                             if (opcode == op_decorate && o[1] == decoration_no_contraction)
                               decorated.insert(o[0]);
                             if (arithmetic.contains(opcode)) operations.insert(o[1]);
                           });
      EXPECT_EQ(decorated, operations) << kernel_name(kernel);
      if (kernel == Kernel::shade) {
        EXPECT_GT(operations.size(), 400U);
      }
    }
  }
}

/// GLSL's own transcendental functions differ between drivers; the kernels use ours.
TEST(SharedLayout, kernels_use_no_builtin_transcendental_function) {
  // Of GLSL.std.450: what is exact. FAbs, SAbs, Floor, Sqrt, FMin, UMin, SMin, FMax, UMax, SMax, SClamp,
  // UClamp
  const std::set<std::uint32_t> exact{4, 5, 8, 31, 37, 38, 39, 40, 41, 42, 44, 45};
  for (const Kernel kernel : kernels) {
    for_each_instruction(kernel_code(kernel, GeometryFetch::texel_buffer),
                         [&](std::uint32_t opcode, std::span<const std::uint32_t> o) {
                           constexpr std::uint32_t op_ext_inst = 12;
                           if (opcode != op_ext_inst) return;
                           EXPECT_TRUE(exact.contains(o[3]))
                               << kernel_name(kernel) << ": GLSL.std.450 " << o[3];
                         });
  }
}

}  // namespace
}  // namespace facet
