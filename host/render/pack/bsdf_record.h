#pragma once
// BSDFs as the kernels read them: where each declared parameter (scene/plugin/parameter.h) lies in
// a shared::BsdfRecord.
#include <array>
#include <stdexcept>
#include <string>

#include "scene/bsdf/bsdf.h"
#include "shared/records.h"

namespace facet {

/// A place in a record's rows a, b, c: a colour's is a whole rgb.
struct RecordPlace {
  std::size_t row = 0;
  glm::length_t component = 0;
};

/// Gives the parameters of one BSDF their places, in order of declaration: roughness a.w, which can
/// be textured; colours the rows from the front, of which the first two can be textured; other
/// numbers the components of the last row, then b.w. A visitor, which tells `Sink` of each:
///
///     sink.color(name, place, value, texture)     texture: none where it can have none
///     sink.number(name, place, value, texture)
///     sink.flag(bit, is_set)
///
/// Throws std::length_error where the record is too small: it then wants another row.
template <typename Sink>
class RecordLayout {
 public:
  explicit RecordLayout(Sink& sink) : sink_(sink) {}

  void operator()(const char* name, const Textured<Color>& value, const parameter::Reflectance&,
                  const char* /*meaning*/) {
    sink_.color(name, color_place(textured_rows), value.value, value.texture);
  }
  void operator()(const char* name, const Color& value, const parameter::Reflectance&,
                  const char* /*meaning*/) {
    derived(name, value);
  }
  void operator()(const char* name, const Textured<float>& value, const parameter::Roughness&,
                  const char* /*meaning*/) {
    sink_.number(name, roughness_place(), value.value, value.texture);
  }
  void operator()(const char* name, float value, const parameter::Roughness&,
                  const char* /*meaning*/) {
    sink_.number(name, roughness_place(), value, none);
  }
  template <typename Kind>
  void operator()(const char* name, float value, const Kind& /*kind*/, const char* /*meaning*/) {
    derived(name, value);
  }
  template <typename Value, typename Words>
  void operator()(const char* /*name*/, const Value& value, const parameter::Choice<Words>& kind,
                  const char* /*meaning*/) {
    sink_.flag(kind.flag, value != kind.words.front().value);
  }
  void operator()(const char* /*name*/, bool value, const parameter::Switch& kind,
                  const char* /*meaning*/) {
    sink_.flag(kind.flag, value);
  }
  /// Kernels read what the plugin derives from these.
  void operator()(const char* /*name*/, const std::string& /*value*/, const parameter::WordOf&,
                  const char* /*meaning*/) {}
  void operator()(const char* /*name*/, const std::optional<Color>& /*value*/,
                  const parameter::ColorBetween&, const char* /*meaning*/) {}

  void derived(const char* name, const Color& value) {
    sink_.color(name, color_place(rows), value, none);
  }
  void derived(const char* name, float value) { sink_.number(name, number_place(), value, none); }

 private:
  static constexpr std::size_t rows = 3;
  static constexpr std::size_t textured_rows = 2;
  static constexpr std::array<RecordPlace, 5> number_places{
      {{2, 0}, {2, 1}, {2, 2}, {2, 3}, {1, 3}}};

  RecordPlace color_place(std::size_t limit) {
    const bool numbers_begin = colors_ == rows - 1 && numbers_ > 0;
    if (colors_ == limit || numbers_begin)
      throw std::length_error("shared::BsdfRecord has no row left for a colour");
    return {colors_++, 0};
  }
  RecordPlace number_place() {
    if (numbers_ == number_places.size() || colors_ == rows)
      throw std::length_error("shared::BsdfRecord has no place left for a number");
    return number_places.at(numbers_++);
  }
  RecordPlace roughness_place() {
    if (has_roughness_) throw std::length_error("shared::BsdfRecord holds one roughness");
    has_roughness_ = true;
    return {0, 3};
  }

  Sink& sink_;
  std::size_t colors_ = 0;
  std::size_t numbers_ = 0;
  bool has_roughness_ = false;
};

/// The record that the kernels read.
[[nodiscard]] shared::BsdfRecord pack_bsdf(const Bsdf& bsdf);

}  // namespace facet
