#pragma once
// Where each declared parameter (scene/plugin/parameter.h) lies in the record by which the kernels
// read an object: rows of four floats, and the textures of some of them (shared/records.h).
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "scene/plugin/parameter.h"

namespace facet {

/// A component of a record's row; a vector lies in the first three of a row.
struct RecordPlace {
  std::size_t row = 0;
  glm::length_t component = 0;

  bool operator==(const RecordPlace&) const = default;
};

/// What a kind of record has room for.
struct RecordShape {
  const char* name;
  std::size_t rows;
  std::size_t textured_rows;             ///< the first ones, whose vector a texture can give
  std::span<const RecordPlace> numbers;  ///< in the order in which numbers take them
  std::optional<RecordPlace> roughness;  ///< which a texture can give
  bool has_flags;
};

namespace record_shape {

inline constexpr std::array<RecordPlace, 5> bsdf_numbers{{{2, 0}, {2, 1}, {2, 2}, {2, 3}, {1, 3}}};
inline constexpr std::array<RecordPlace, 2> fourth_components{{{0, 3}, {1, 3}}};

inline constexpr RecordShape bsdf{"shared::BsdfRecord", 3,   2, bsdf_numbers,
                                  RecordPlace{0, 3},    true};
inline constexpr RecordShape emitter{"shared::EmitterRecord", 2, 1, fourth_components, {}, false};
inline constexpr RecordShape texture{"shared::TextureRecord", 2, 0, fourth_components, {}, false};

}  // namespace record_shape

/// Gives the parameters of one object their places, in order of declaration: vectors (colours,
/// points) the rows from the front, numbers and roughness what the shape has for them. A visitor,
/// which tells `Sink` of each:
///
///     sink.vector(name, place, value, texture)     texture: none where it can have none
///     sink.number(name, place, value, texture)
///     sink.flag(bit, is_set)
///
/// Throws std::length_error where the record is too small: it then wants another row.
template <typename Sink>
class RecordLayout {
 public:
  RecordLayout(const RecordShape& shape, Sink& sink) : shape_(shape), sink_(sink) {}

  void operator()(const char* name, const Textured<Color>& value, const parameter::Reflectance&,
                  const char* /*meaning*/) {
    textured(name, value);
  }
  void operator()(const char* name, const Textured<Color>& value,
                  const parameter::NonNegativeColor& kind, const char* /*meaning*/) {
    textured(name, kind.scaled(value));
  }
  void operator()(const char* name, const Color& value, const parameter::NonNegativeColor& kind,
                  const char* /*meaning*/) {
    derived(name, kind.scaled(value).value);
  }
  template <typename Kind>
  void operator()(const char* name, const vec3& value, const Kind& /*kind*/,
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
  void operator()(const char* name, int value, const parameter::Count& /*kind*/,
                  const char* /*meaning*/) {
    derived(name, static_cast<float>(value));
  }
  template <typename Value, typename Words>
  void operator()(const char* /*name*/, const Value& value, const parameter::Choice<Words>& kind,
                  const char* /*meaning*/) {
    flag(kind.flag, value != kind.words.front().value);
  }
  void operator()(const char* /*name*/, bool value, const parameter::Switch& kind,
                  const char* /*meaning*/) {
    flag(kind.flag, value);
  }
  /// The colour that it scales is read with it.
  void operator()(const char* /*name*/, double /*value*/, const parameter::Scale&,
                  const char* /*meaning*/) {}
  /// Of these, kernels read what the plugin makes of them.
  template <typename Kind>
  void operator()(const char* /*name*/, const std::string& /*value*/, const Kind& /*kind*/,
                  const char* /*meaning*/) {}
  template <typename Kind>
  void operator()(const char* /*name*/, const std::optional<Color>& /*value*/, const Kind& /*kind*/,
                  const char* /*meaning*/) {}

  void derived(const char* name, const vec3& value) {
    sink_.vector(name, vector_place(shape_.rows), value, none);
  }
  void derived(const char* name, float value) { sink_.number(name, number_place(), value, none); }

 private:
  /// bit: 0 where the value decides something else than the kernels' work.
  void flag(std::uint32_t bit, bool is_set) {
    if (bit != 0 && !shape_.has_flags) fail("a flag");
    sink_.flag(bit, is_set);
  }
  void textured(const char* name, const Textured<Color>& value) {
    sink_.vector(name, vector_place(shape_.textured_rows), value.value, value.texture);
  }

  [[noreturn]] void fail(const char* what) const {
    throw std::length_error(std::string(shape_.name) + " has no place left for " + what);
  }

  RecordPlace vector_place(std::size_t limit) {
    if (vectors_ == limit) fail("a vector");
    const RecordPlace place{vectors_++, 0};
    for (const RecordPlace& number : shape_.numbers.first(numbers_)) {
      if (is_within(number, place)) fail("a vector");
    }
    return place;
  }
  RecordPlace number_place() {
    if (numbers_ == shape_.numbers.size()) fail("a number");
    const RecordPlace place = shape_.numbers[numbers_++];
    if (place.row < vectors_ && is_within(place, {place.row, 0})) fail("a number");
    return place;
  }
  RecordPlace roughness_place() {
    if (!shape_.roughness || has_roughness_) fail("a roughness");
    has_roughness_ = true;
    return *shape_.roughness;
  }
  /// Whether a number is in the row of a vector, in a component that the vector takes.
  static bool is_within(const RecordPlace& number, const RecordPlace& vector) {
    return number.row == vector.row && number.component < 3;
  }

  const RecordShape& shape_;
  Sink& sink_;
  std::size_t vectors_ = 0;
  std::size_t numbers_ = 0;
  bool has_roughness_ = false;
};

}  // namespace facet
