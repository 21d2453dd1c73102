#pragma once
// The words by which files and options call the values of enumerations.
#include <facet/film.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace facet {

template <typename Value>
struct Word {
  Value value;
  const char* word;
};
template <typename Value>
Word(Value, const char*) -> Word<Value>;

inline constexpr std::array heuristic_words{Word{Heuristic::balance, "balance"},
                                            Word{Heuristic::power, "power"}};
inline constexpr std::array emitter_selection_words{
    Word{EmitterSelection::contribution, "contribution"}, Word{EmitterSelection::power, "power"},
    Word{EmitterSelection::uniform, "uniform"}};
inline constexpr std::array area_sampling_words{Word{AreaSampling::area, "area"},
                                                Word{AreaSampling::solid_angle, "solidangle"}};
inline constexpr std::array environment_sampling_words{
    Word{EnvironmentSampling::compensated, "compensated"},
    Word{EnvironmentSampling::radiance, "radiance"}};
inline constexpr std::array masking_words{Word{Masking::rational, "rational"},
                                          Word{Masking::exact, "exact"}};
inline constexpr std::array lobe_sampling_words{Word{LobeSampling::ndf, "ndf"},
                                                Word{LobeSampling::visible, "visible"},
                                                Word{LobeSampling::uniform, "uniform"}};
inline constexpr std::array precision_words{Word{Precision::float_, "float"},
                                            Word{Precision::double_, "double"}};

inline constexpr std::array stopped_by_words{
    Word{StoppedBy::samples, "samples"}, Word{StoppedBy::error, "error"},
    Word{StoppedBy::time, "time"}, Word{StoppedBy::interrupt, "interrupt"}};

/// The words alone, of the first `count`.
template <typename Words>
[[nodiscard]] std::vector<std::string> names_of(const Words& words,
                                                std::size_t count = Words().size()) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.emplace_back(words.at(i).word);
  return names;
}

template <typename Words, typename Value>
[[nodiscard]] std::string word_of(const Words& words, const Value& value) {
  for (const auto& w : words) {
    if (w.value == value) return w.word;
  }
  return "";
}

/// Nothing for an unknown word.
template <typename Value, std::size_t count>
[[nodiscard]] std::optional<Value> value_of(const std::array<Word<Value>, count>& words,
                                            std::string_view word) {
  for (const auto& w : words) {
    if (word == w.word) return w.value;
  }
  return std::nullopt;
}

}  // namespace facet
