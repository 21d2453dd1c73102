#include "extremes/bsdf_inputs.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scene/bsdf/traits.h"
#include "scene/plugin/parameter.h"

namespace facet::extremes {

namespace {

constexpr std::size_t cases_of_each = 36;

/// Gives each declared parameter the value of a case, and notes it.
class Extreme {
 public:
  Extreme(std::size_t number, std::string& name) : random_(number), name_(name) {}

  void operator()(const char* what, Textured<Color>& value, const parameter::Reflectance&,
                  const char*) {
    value = color(what);
  }
  void operator()(const char* what, Color& value, const parameter::Reflectance&, const char*) {
    value = color(what);
  }
  void operator()(const char* what, Textured<float>& value, const parameter::Roughness&,
                  const char*) {
    value = roughness(what);
  }
  void operator()(const char* what, float& value, const parameter::Roughness&, const char*) {
    value = roughness(what);
  }
  void operator()(const char* what, float& value, const parameter::RefractiveIndex&, const char*) {
    value = one_of(what, std::array{1.0F, 1.5F, 1.0001F, 1.000277F, 2.5F});
  }
  void operator()(const char* what, float& value, const parameter::Between& kind, const char*) {
    value = one_of(what, std::array{static_cast<float>(kind.least), static_cast<float>(kind.most),
                                    static_cast<float>(0.5 * (kind.least + kind.most))});
  }
  void operator()(const char* what, bool& value, const parameter::Switch&, const char*) {
    value = one_of(what, std::array{0.0F, 0.0F, 0.0F, 1.0F}) > 0;
  }
  template <typename Value, typename Words>
  void operator()(const char*, Value& value, const parameter::Choice<Words>& kind, const char*) {
    const auto& word = kind.words.at(random_.below(kind.words.size()));
    value = word.value;
    name_ += fmt::format(" {}", word.word);
  }
  /// What has no range of its own, or excludes others, keeps its default.
  template <typename Value, typename Kind>
  void operator()(const char*, Value&, const Kind&, const char*) {}
  template <typename Value>
  void derived(const char*, const Value&) {}

 private:
  template <std::size_t n>
  float one_of(const char* what, const std::array<float, n>& values) {
    const float value = values.at(random_.below(n));
    name_ += fmt::format(" {} {}", what, value);
    return value;
  }
  float roughness(const char* what) {
    return one_of(what, std::array{1e-4F, 1e-3F, 0.01F, 0.1F, 0.5F, 1.0F});
  }
  Color color(const char* what) {
    const float x = one_of(what, std::array{0.0F, 0.5F, 0.5F, 1.0F});
    return x == 0.5F ? Color(0, 0.5F, 1) : Color(x);
  }

  Random random_;
  std::string& name_;
};

template <typename T>
std::vector<BsdfCase> cases_of(T p) {
  std::vector<BsdfCase> cases;
  for (std::size_t i = 0; i < cases_of_each; ++i) {
    BsdfCase c;
    Extreme extreme(i, c.name);
    T::declare(p, extreme);
    c.sampling = i % 2 == 0 ? LobeSampling::visible : LobeSampling::ndf;
    c.name += i % 2 == 0 ? " visible" : " ndf";
    if constexpr (requires { p.flags(); }) {
      c.transmits = (p.flags() & shared::BSDF_TRANSMITS) != 0;
      c.is_delta = (p.flags() & shared::BSDF_DELTA) != 0;
    }
    c.bsdf = p;
    c.alpha = static_cast<double>(roughness_of(c.bsdf));
    c.ext_ior = index_of_side(c.bsdf, false);
    c.int_ior = index_of_side(c.bsdf, true);
    cases.push_back(c);
  }
  return cases;
}

vec3 rounded(const dvec3& d) { return {d.x, d.y, d.z}; }

dvec3 at_angles(double cosine, double turns) {
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  const double angle = 2 * std::numbers::pi * turns;
  return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

/// Between 10^-digits and 1, each order of magnitude as often.
double small(Random& random, double digits) { return std::pow(10, -digits * random.number()); }

/// On the upper side.
dvec3 anywhere(Random& random) {
  const double turns = random.number();
  switch (random.below(4)) {
    case 0:
      return at_angles(small(random, 7), turns);
    case 1: {
      const double sine = small(random, 8);
      return at_angles(std::sqrt((1 - sine) * (1 + sine)), turns);
    }
    case 2:
      if (random.below(8) == 0) return {0, 0, 1};
      if (random.below(8) == 0) return at_angles(1e-7, 0.25 * static_cast<double>(random.below(4)));
      return at_angles(0.01 + 0.99 * random.number(), turns);
    default:
      return at_angles(1 - random.number(), turns);
  }
}

/// A normal of the microfacets, out to where their density ends.
dvec3 microfacet(const BsdfCase& c, Random& random) {
  const double tangent = c.alpha * std::sqrt(-std::log(1 - random.number())) * 3 * random.number();
  return at_angles(1 / std::sqrt(1 + tangent * tangent), random.number());
}

/// Each component some roundings away.
dvec3 jittered(const dvec3& d, Random& random) {
  const double by = small(random, 7);
  const auto offset = [&] { return by * (2 * random.number() - 1); };
  return glm::normalize(d + dvec3(offset(), offset(), offset()));
}

/// Through a microfacet, by Snell's law; reflected where that is total.
dvec3 refracted(const BsdfCase& c, const dvec3& wo, const dvec3& h) {
  const double ratio = wo.z > 0 ? c.ext_ior / c.int_ior : c.int_ior / c.ext_ior;
  const dvec3 facing = glm::dot(wo, h) < 0 ? -h : h;
  const double cosine = glm::dot(wo, facing);
  const double cos2 = 1 - ratio * ratio * (1 - cosine * cosine);
  if (cos2 <= 0) return 2 * cosine * facing - wo;
  return (ratio * cosine - std::sqrt(cos2)) * facing - ratio * wo;
}

}  // namespace

std::vector<BsdfCase> bsdf_cases(std::size_t id) {
  switch (id) {
#define FACET_CASES(name, Type, number) \
  case number:                          \
    return cases_of(bsdf::Type{});
    FACET_BSDF_LIST(FACET_CASES)
#undef FACET_CASES
    default:
      return {};
  }
}

vec3 view_direction(const BsdfCase& c, Random& random) {
  dvec3 wo = anywhere(random);
  if (c.transmits && random.below(2) == 0) wo.z = -wo.z;
  return rounded(wo);
}

statistics::DirectionPair direction_pair(const BsdfCase& c, Random& random) {
  const vec3 wo = view_direction(c, random);
  const dvec3 o(wo);
  const dvec3 h = microfacet(c, random);
  switch (random.below(8)) {
    case 0:
    case 1:
    case 2:
      return {wo, rounded(2 * glm::dot(o, h) * h - o)};
    case 3:
    case 4:
      if (c.transmits) return {wo, rounded(refracted(c, o, h))};
      return {wo, rounded(anywhere(random))};
    case 5:
      return {wo, random.below(4) == 0 ? -wo : rounded(jittered(-o, random))};
    case 6:
      return {wo, random.below(4) == 0 ? wo : rounded(jittered(o, random))};
    default:
      return {wo, view_direction(c, random)};
  }
}

statistics::BsdfNumbers sample_numbers(Random& random) {
  const auto number = [&] {
    switch (random.below(8)) {
      case 0:
        return 0.0F;
      case 1:
        return 1 - 0x1p-24F;
      case 2:
        return static_cast<float>(small(random, 7) * 0.9);
      default:
        return static_cast<float>(static_cast<double>(random.below(1U << 24U)) * 0x1p-24);
    }
  };
  const float lobe = number();
  const float u = number();
  return {lobe, u, number()};
}

}  // namespace facet::extremes
