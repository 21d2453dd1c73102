#include "render/pack/parameter_records.h"

#include "render/pack/record_layout.h"

namespace facet {

namespace {

/// Collects what a record holds of an object's parameters.
struct RecordWriter {
  std::array<glm::vec4, 3> rows{};
  std::array<std::uint32_t, 3> textures{none, none, none};  ///< of the rows' vectors
  std::uint32_t roughness_texture = none;
  std::uint32_t flags = 0;

  void vector(const char* /*name*/, RecordPlace place, const vec3& value, std::uint32_t texture) {
    glm::vec4& row = rows.at(place.row);
    row = glm::vec4(value, row.w);
    textures.at(place.row) = texture;
  }
  void number(const char* /*name*/, RecordPlace place, float value, std::uint32_t texture) {
    rows.at(place.row)[place.component] = value;
    if (texture != none) roughness_texture = texture;
  }
  void flag(std::uint32_t bit, bool is_set) { flags |= is_set ? bit : 0; }
};

template <typename Variant>
RecordWriter written(const Variant& object, const RecordShape& shape) {
  RecordWriter writer;
  RecordLayout<RecordWriter> layout(shape, writer);
  std::visit(
      [&](const auto& parameters) {
        parameters.declare(parameters, layout);
        if constexpr (requires { parameters.flags(); }) writer.flag(parameters.flags(), true);
      },
      object);
  return writer;
}

}  // namespace

shared::BsdfRecord pack_bsdf(const Bsdf& bsdf) {
  const RecordWriter writer = written(bsdf, record_shape::bsdf);
  shared::BsdfRecord record{};
  record.type = static_cast<std::uint32_t>(bsdf.index());
  record.flags = writer.flags;
  record.texture_a = writer.textures[0];
  record.texture_b = writer.textures[1];
  record.texture_alpha = writer.roughness_texture;
  record.a = writer.rows[0];
  record.b = writer.rows[1];
  record.c = writer.rows[2];
  return record;
}

shared::EmitterRecord pack_emitter(const Emitter& emitter) {
  const RecordWriter writer = written(emitter, record_shape::emitter);
  shared::EmitterRecord record{};
  record.type = static_cast<std::uint32_t>(emitter.index());
  record.texture_a = writer.textures[0];
  record.a = writer.rows[0];
  record.b = writer.rows[1];
  return record;
}

shared::TextureRecord pack_texture(const Texture& texture) {
  const RecordWriter writer = written(texture, record_shape::texture);
  shared::TextureRecord record{};
  record.a = writer.rows[0];
  record.b = writer.rows[1];
  return record;
}

}  // namespace facet
