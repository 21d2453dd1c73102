// Declared parameters find their places in the kernels' records.
#include "render/pack/parameter_records.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "render/pack/record_layout.h"

namespace facet::test {

namespace {

TEST(ParameterRecords, an_area_emitter_has_its_radiance_with_the_scale) {
  const shared::EmitterRecord record =
      pack_emitter(AreaEmitter{.radiance = Color(1, 2, 3), .scale = 10});
  EXPECT_EQ(Color(record.a), Color(10, 20, 30));
  EXPECT_EQ(record.texture_a, shared::NONE);
}

TEST(ParameterRecords, of_a_textured_emitter_the_scale_is_a_factor_on_the_texture) {
  AreaEmitter emitter{.radiance = Color(1, 2, 3), .scale = 10};
  emitter.radiance.texture = 4;
  const shared::EmitterRecord record = pack_emitter(emitter);
  EXPECT_EQ(Color(record.a), Color(10));
  EXPECT_EQ(record.texture_a, 4U);
}

TEST(ParameterRecords, a_point_light_has_position_and_intensity) {
  const shared::EmitterRecord record = pack_emitter(PointLight{{1, 2, 3}, Color(4, 5, 6)});
  EXPECT_EQ(vec3(record.a), vec3(1, 2, 3));
  EXPECT_EQ(Color(record.b), Color(4, 5, 6));
}

TEST(ParameterRecords, an_environment_has_nothing_but_its_type) {
  const shared::EmitterRecord record = pack_emitter(EnvironmentEmitter{});
  EXPECT_EQ(record.type, 1U);
  EXPECT_EQ(record.a, glm::vec4(0));
  EXPECT_EQ(record.texture_a, shared::NONE);
}

TEST(ParameterRecords, textures_have_colours_and_counts) {
  CheckerTexture checker;
  checker.both = Color(0.5F);
  checker.second = Color(0.25F);
  checker.scale_x = 3;
  checker.scale_y = 4;
  const shared::TextureRecord cells = pack_texture(checker);
  EXPECT_EQ(cells.a, glm::vec4(0.5F, 0.5F, 0.5F, 3));
  EXPECT_EQ(cells.b, glm::vec4(0.25F, 0.25F, 0.25F, 4));
  BitmapTexture bitmap;
  bitmap.factor = Color(1, 2, 3);
  bitmap.scale_x = -1;
  bitmap.scale_y = 0.5F;
  const shared::TextureRecord image = pack_texture(bitmap);
  EXPECT_EQ(image.a, glm::vec4(1, 2, 3, -1));
  EXPECT_EQ(image.b.w, 0.5F);
}

/// Wants places without end.
struct Anywhere {
  std::vector<RecordPlace> places;

  void vector(const char* /*name*/, RecordPlace place, const vec3& /*value*/,
              std::uint32_t /*texture*/) {
    places.push_back(place);
  }
  void number(const char* /*name*/, RecordPlace place, float /*value*/, std::uint32_t /*texture*/) {
    places.push_back(place);
  }
  void flag(std::uint32_t /*bit*/, bool /*is_set*/) {}
};

TEST(RecordLayout, vectors_and_numbers_never_share_a_place) {
  Anywhere sink;
  RecordLayout<Anywhere> layout(record_shape::bsdf, sink);
  layout.derived("first number", 1.0F);
  layout.derived("first vector", vec3(0));
  layout.derived("second vector", vec3(0));
  const std::vector<RecordPlace> expected{{2, 0}, {0, 0}, {1, 0}};
  EXPECT_EQ(sink.places, expected);
  EXPECT_THROW(layout.derived("no row left", vec3(0)), std::length_error);
}

TEST(RecordLayout, a_number_does_not_enter_the_row_of_a_vector) {
  Anywhere sink;
  RecordLayout<Anywhere> layout(record_shape::bsdf, sink);
  for (int i = 0; i < 3; ++i) layout.derived("vector", vec3(0));
  EXPECT_THROW(layout.derived("number", 1.0F), std::length_error);
}

TEST(RecordLayout, fourth_components_stay_free_beside_vectors) {
  Anywhere sink;
  RecordLayout<Anywhere> layout(record_shape::texture, sink);
  for (int i = 0; i < 2; ++i) {
    layout.derived("vector", vec3(0));
    layout.derived("number", 1.0F);
  }
  const std::vector<RecordPlace> expected{{0, 0}, {0, 3}, {1, 0}, {1, 3}};
  EXPECT_EQ(sink.places, expected);
  EXPECT_THROW(layout.derived("number", 1.0F), std::length_error);
}

TEST(RecordLayout, a_record_without_flags_takes_none) {
  Anywhere sink;
  RecordLayout<Anywhere> layout(record_shape::emitter, sink);
  layout("decides nothing on the device", true, parameter::Switch{}, "");
  EXPECT_THROW(layout("flag", true, parameter::Switch{4}, ""), std::length_error);
}

TEST(RecordLayout, only_the_first_rows_can_be_textured) {
  Anywhere sink;
  RecordLayout<Anywhere> layout(record_shape::emitter, sink);
  layout("first", Textured<Color>(Color(1)), parameter::Reflectance{}, "");
  EXPECT_THROW(layout("second", Textured<Color>(Color(1)), parameter::Reflectance{}, ""),
               std::length_error);
}

}  // namespace

}  // namespace facet::test
