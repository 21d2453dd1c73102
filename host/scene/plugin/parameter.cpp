#include "scene/plugin/parameter.h"

#include <fmt/format.h>

#include "scene/xml/property_reader.h"

namespace facet::parameter {

namespace {

std::string between(double least, double most) { return fmt::format("{:g} to {:g}", least, most); }

}  // namespace

std::string one_of(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "`" : ", `") + word + "`";
  return text;
}

std::string Reflectance::range() const { return between(0, 1); }
std::string NonNegativeColor::range() const {
  return between(0, static_cast<double>(largest_radiance));
}
std::string ColorBetween::range() const {
  return between(static_cast<double>(least), static_cast<double>(most));
}
std::string Roughness::range() const { return between(least_roughness, 1); }
std::string RefractiveIndex::range() const { return between(least_index, largest_index); }
std::string Between::range() const { return between(least, most); }
std::string AtLeast::range() const { return fmt::format("at least {:g}", bound); }
std::string Inside::range() const {
  return fmt::format("more than {:g}, less than {:g}", least, most);
}
std::string Factor::range() const { return fmt::format("{} to {}", -most, most); }
std::string Count::range() const {
  constexpr int beyond_use = 1 << 30;
  return most < beyond_use ? fmt::format("{} to {}", least, most)
                           : fmt::format("at least {}", least);
}

}  // namespace facet::parameter
