#pragma once
// Declared parameters (parameter.h) in words, for manuals.
#include <fmt/format.h>

#include <optional>

#include "scene/plugin/parameter.h"

namespace facet {

/// One line of a plugin's table of parameters.
struct ParameterInfo {
  std::string name;
  std::string type;      ///< "colour or texture"
  std::string range;     ///< "0 to 1"; empty where the type says all
  std::string fallback;  ///< the default; empty without
  std::string meaning;
};

/// A default in words: empty where it stands for nothing.
[[nodiscard]] std::string default_text(const Color& value);
[[nodiscard]] std::string default_text(const std::string& value);
[[nodiscard]] std::string default_text(const dmat4& value);
template <typename Number>
requires std::is_arithmetic_v<Number>
[[nodiscard]] std::string default_text(Number value) {
  if constexpr (std::is_same_v<Number, double>) return fmt::format("{:.6g}", value);
  return fmt::format("{}", value);
}
template <typename Value>
[[nodiscard]] std::string default_text(const Textured<Value>& value) {
  return default_text(value.value);
}
template <typename Value>
[[nodiscard]] std::string default_text(const std::optional<Value>& value) {
  return value ? default_text(*value) : "";
}
template <typename Value>
[[nodiscard]] std::string default_text(const std::vector<Value>& /*value*/) {
  return "";
}

/// The visitor that lists parameters, in order of declaration.
class ParameterList {
 public:
  template <typename Value, typename Kind>
  void operator()(const char* name, const Value& value, const Kind& kind, const char* meaning) {
    const bool textured = requires { value.texture; };
    std::string fallback;
    if constexpr (requires { kind.words.front().value; }) {
      fallback = word_of(kind.words, value);
    } else {
      fallback = default_text(value);
    }
    list_.push_back({name, std::string(kind.type) + (textured ? " or texture" : ""), kind.range(),
                     fallback, meaning});
  }
  void operator()(const char* name, const vec3& value, const parameter::Point& kind,
                  const char* meaning) {
    list_.push_back({name, parameter::Point::type, kind.range(),
                     fmt::format("{}, {}, {}", value.x, value.y, value.z), meaning});
  }
  template <typename Value>
  void derived(const char* /*name*/, const Value& /*value*/) {}

  [[nodiscard]] const std::vector<ParameterInfo>& list() const { return list_; }

 private:
  std::vector<ParameterInfo> list_;
};

/// The parameters that `Type` declares, with the values of an object as defaults.
template <typename Type>
[[nodiscard]] std::vector<ParameterInfo> list_parameters(const Type& value = {}) {
  ParameterList list;
  Type::declare(value, list);
  return list.list();
}

/// A Markdown table, with a blank line before it; empty without parameters.
[[nodiscard]] std::string table_of(const std::vector<ParameterInfo>& parameters);

}  // namespace facet
