#include "cli/metadata.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "cli/sample_ranges.h"
#include "image/part.h"

namespace facet::cli {

std::string shell_word(const std::string& word) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:,+=";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::optional<std::string> find_metadata(const Image& image, const std::string& key) {
  const std::string* text = facet::find_metadata(image.metadata, key);
  return text != nullptr ? std::optional(*text) : std::nullopt;
}

std::string rerun_command(const Image& image, int x, int y) {
  const std::optional<std::string> scene = find_metadata(image, "facet.scene");
  if (!scene) return "";
  std::string command = fmt::format("facet render --pixel {},{} --resolution {}x{}", x, y,
                                    image.window.full_width, image.window.full_height);
  constexpr std::array<std::pair<const char*, const char*>, 9> options{
      {{"facet.integrator", "--integrator"},
       {"facet.sampler", "--sampler"},
       {"facet.samples", "--sample-range"},
       {"facet.seed", "--seed"},
       {"facet.maxDepth", "--max-depth"},
       {"facet.sampling", "--sampling"},
       {"facet.heuristic", "--heuristic"},
       {"facet.emitterSelection", "--emitter-selection"},
       {"facet.backend", "--backend"}}};
  for (const auto& [key, option] : options) {
    const std::optional<std::string> value = find_metadata(image, key);
    // An option's value may begin with a minus.
    if (value) command += fmt::format(" {}={}", option, shell_word(*value));
  }
  if (find_metadata(image, "facet.backend") == "reference" &&
      find_metadata(image, "facet.precision") == "double")
    command += " --precision=double";
  // A name may begin with a minus.
  return command + " -- " + shell_word(*scene);
}

bool share_samples(const Image& a, const Image& b) {
  for (const char* key : {"facet.scene", "facet.seed", "facet.sampler"}) {
    const std::optional<std::string> value = find_metadata(a, key);
    if (!value || value != find_metadata(b, key)) return false;
  }
  const auto ranges_of = [](const Image& image) {
    return SampleRanges::parse(find_metadata(image, "facet.samples").value_or(""));
  };
  const auto ranges_a = ranges_of(a);
  const auto ranges_b = ranges_of(b);
  return ranges_a && ranges_b && !ranges_a->common(*ranges_b).empty();
}

}  // namespace facet::cli
