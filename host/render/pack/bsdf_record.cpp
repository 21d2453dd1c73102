#include "render/pack/bsdf_record.h"

namespace facet {

namespace {

/// Writes parameters into a record.
struct RecordWriter {
  shared::BsdfRecord record{};

  void color(const char* /*name*/, RecordPlace place, const Color& value, std::uint32_t texture) {
    glm::vec4& row = this->row(place);
    row = glm::vec4(value, row.w);
    if (texture != none) (place.row == 0 ? record.texture_a : record.texture_b) = texture;
  }
  void number(const char* /*name*/, RecordPlace place, float value, std::uint32_t texture) {
    row(place)[place.component] = value;
    if (texture != none) record.texture_alpha = texture;
  }
  void flag(std::uint32_t bit, bool is_set) { record.flags |= is_set ? bit : 0; }

 private:
  glm::vec4& row(RecordPlace place) {
    return place.row == 0 ? record.a : place.row == 1 ? record.b : record.c;
  }
};

}  // namespace

shared::BsdfRecord pack_bsdf(const Bsdf& bsdf) {
  RecordWriter writer;
  writer.record.type = static_cast<std::uint32_t>(bsdf.index());
  writer.record.texture_a = writer.record.texture_b = writer.record.texture_alpha = none;
  std::visit(
      [&](const auto& parameters) {
        RecordLayout<RecordWriter> layout(writer);
        std::decay_t<decltype(parameters)>::declare(parameters, layout);
        if constexpr (requires { parameters.flags(); }) writer.flag(parameters.flags(), true);
      },
      bsdf);
  return writer.record;
}

}  // namespace facet
