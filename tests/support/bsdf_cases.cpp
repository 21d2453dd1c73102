#include "support/bsdf_cases.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace facet::test {

namespace {

using namespace bsdf;

/// Reflectances 0 and 1 and one between, a channel each.
const Color all_reflectances(0, 0.5F, 1);

constexpr MicrofacetOptions exact_masking{Distribution::beckmann, Masking::exact};

// What varies beside roughness, distribution and sampling; the cases take them in turn. Five or
// three: coprime to the seven roughnesses.
std::vector<Diffuse> variants(const Diffuse& /*type*/) { return {{all_reflectances}, {Color(1)}}; }
std::vector<Mirror> variants(const Mirror& /*type*/) { return {{}}; }
std::vector<Dielectric> variants(const Dielectric& /*type*/) {
  return {{1, 1.5F}, {1.5F, 1}, {1, 1.02F}, {1.3F, 1.3F}};
}
std::vector<RoughConductor> variants(const RoughConductor& /*type*/) {
  RoughConductor schlick{all_reflectances};
  RoughConductor exact{Color(0.04F, 0.9F, 1)};
  exact.options = exact_masking;
  RoughConductor multiscatter{all_reflectances};
  multiscatter.multiscatter = true;
  RoughConductor exact_multiscatter = multiscatter;
  exact_multiscatter.options = exact_masking;
  RoughConductor metal;
  const ConductorIor gold = find_metal("Au").value();
  metal.eta = gold.eta;
  metal.k = gold.k;
  return {schlick, exact, multiscatter, metal, exact_multiscatter};
}
std::vector<RoughSubstrate> variants(const RoughSubstrate& /*type*/) {
  RoughSubstrate exact{Color(0.2F, 0.5F, 0.1F), 0.1F, 1, 1.5F};
  exact.options = exact_masking;
  return {{all_reflectances, 0.1F, 1, 1.5F},
          {Color(0), 0.1F, 1, 1.5F},
          {Color(0.5F), 0.1F, 1.5F, 1},
          {Color(0.5F), 0.1F, 1, 1.02F},
          exact};
}
std::vector<Microfacet> variants(const Microfacet& /*type*/) {
  return {{0.1F, 1, 1.5F, all_reflectances},
          {0.1F, 1, 1.5F, Color(0)},
          {0.1F, 1, 1.5F, Color(0.2F, 0.5F, 0.1F)},
          {0.1F, 1.5F, 1, Color(0.3F)},
          {0.1F, 1, 1.02F, Color(0.5F)}};
}
std::vector<FresnelBlend> variants(const FresnelBlend& /*type*/) {
  return {{all_reflectances, Color(0.05F)},
          {Color(0.5F), all_reflectances},
          {Color(0), Color(1)},
          {Color(1), Color(0)},
          {Color(0.2F, 0.5F, 0.1F), Color(0.5F)}};
}
std::vector<RoughDielectric> variants(const RoughDielectric& /*type*/) {
  return {{all_reflectances, 0.1F, 1, 1.5F}, {Color(1), 0.1F, 1.5F, 1}, {Color(1), 0.1F, 1, 1.02F}};
}

/// Of a BSDF that nobody has thought of here: each variant has other values of every parameter.
class Varying {
 public:
  explicit Varying(std::size_t variant) : variant_(variant) {}

  void operator()(const char*, Textured<Color>& value, const parameter::Reflectance&, const char*) {
    value = color();
  }
  void operator()(const char*, Color& value, const parameter::Reflectance&, const char*) {
    value = color();
  }
  void operator()(const char*, float& value, const parameter::RefractiveIndex&, const char*) {
    value = next({1, 1.5F, 1.02F, 2, 1.3F});
  }
  void operator()(const char*, float& value, const parameter::Between& kind, const char*) {
    const auto least = static_cast<float>(kind.least);
    const auto most = static_cast<float>(kind.most);
    value = least + (most - least) * next({0.5F, 0, 1, 0.25F, 0.9F});
  }
  void operator()(const char*, bool& value, const parameter::Switch&, const char*) {
    value = next({0, 1, 1, 0, 1}) > 0;
  }
  template <typename Value, typename Words>
  void operator()(const char*, Value& value, const parameter::Choice<Words>& kind, const char*) {
    value = kind.words.at((variant_ + count_++) % kind.words.size()).value;
  }
  /// Roughness is the cases' own; whatever else there is keeps its default.
  template <typename Value, typename Kind>
  void operator()(const char*, Value&, const Kind&, const char*) {}
  template <typename Value>
  void derived(const char*, const Value&) {}

 private:
  using Five = std::array<float, 5>;
  float next(const Five& values) { return values[(variant_ + 2 * count_++) % values.size()]; }
  Color color() {
    // Not black: a sample without weight counts as rejected.
    const float x = next({0.5F, 0.1F, 1, 0.2F, 0.8F});
    return x == 0.5F ? all_reflectances : Color(x);
  }

  std::size_t variant_;
  std::size_t count_ = 0;  ///< of parameters so far
};

template <typename T>
std::vector<T> variants(const T& defaults) {
  std::vector<T> list(5, defaults);
  for (std::size_t i = 0; i < list.size(); ++i) {
    Varying vary(i);
    T::declare(list[i], vary);
  }
  return list;
}

void set(float& parameter, float value) { parameter = value; }
void set(Textured<float>& parameter, float value) { parameter = value; }

template <typename T>
concept Rough = requires(T t) {
  t.options;
};

/// The variants, one case each.
template <typename T>
std::vector<BsdfCase> expand(const std::vector<T>& variants) {
  std::vector<BsdfCase> cases;
  cases.reserve(variants.size());
  for (const T& v : variants)
    cases.push_back({v, LobeSampling::visible, fmt::format("variant {}", cases.size())});
  return cases;
}

template <Rough T>
std::vector<BsdfCase> expand(const std::vector<T>& variants) {
  std::vector<BsdfCase> cases;
  for (const LobeSampling sampling : {LobeSampling::visible, LobeSampling::ndf}) {
    for (const Distribution distribution : {Distribution::beckmann, Distribution::ggx}) {
      for (const float alpha : roughnesses) {
        const std::size_t which = cases.size() % variants.size();
        T v = variants[which];
        set(v.alpha, alpha);
        v.options.distribution = distribution;
        cases.push_back({v, sampling,
                         fmt::format("variant {}, alpha {}, {}, {}", which, alpha,
                                     distribution == Distribution::ggx ? "ggx" : "beckmann",
                                     sampling == LobeSampling::ndf ? "ndf" : "visible")});
      }
    }
  }
  return cases;
}

}  // namespace

std::vector<BsdfCase> bsdf_cases(std::size_t id) {
  std::vector<BsdfCase> cases;
  switch (id) {
#define FACET_CASES(name, Type, number) \
  case number:                          \
    cases = expand(variants(Type{}));   \
    break;
    FACET_BSDF_LIST(FACET_CASES)
#undef FACET_CASES
    default:
      break;
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    cases[i].name = fmt::format("{}, {}", bsdf_type_names[id], cases[i].name);
    cases[i].number = 100 * id + i;
  }
  return cases;
}

std::vector<vec3> view_directions(const BsdfCase& c) {
  const bool narrow = c.alpha() < 0.05F;
  std::vector<double> cosines{1,    0.99999, 0.9995, 0.995, 0.98, 0.96, 0.93, 0.9,
                              0.86, 0.82,    0.78,   0.74,  0.7,  0.65, 0.6,  0.55,
                              0.5,  0.45,    0.4,    0.35,  0.28, 0.2,  0.1};
  cosines.push_back(narrow ? 0.05 : 0.01);
  cosines.push_back(narrow ? 0.02 : 0.001);
  if (c.transmits())
    cosines.insert(cosines.end(),
                   {-1, -0.995, -0.95, -0.85, -0.76, -0.74, -0.6, -0.4, -0.2, -0.05});
  std::vector<vec3> directions;
  for (std::size_t i = 0; i < cosines.size(); ++i) {
    // Along an axis where grazing: narrow lobes then lie where floats are dense.
    const double turns =
        std::abs(cosines[i]) < 0.3 ? 0.25 * static_cast<double>(i) : 0.618 * static_cast<double>(i);
    const double angle = 2 * std::numbers::pi * turns;
    const double radius = std::sqrt((1 - cosines[i]) * (1 + cosines[i]));
    const auto flat = [&](double x) {
      return std::abs(x) < 1e-9 ? 0.0F : static_cast<float>(radius * x);
    };
    directions.emplace_back(flat(std::cos(angle)), flat(std::sin(angle)),
                            static_cast<float>(cosines[i]));
  }
  return directions;
}

bool full_grid() { return std::getenv("FACET_FULL_GRID") != nullptr; }

std::vector<std::size_t> sampled_directions(const BsdfCase& c, std::size_t count) {
  std::vector<std::size_t> chosen;
  if (full_grid()) {
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(i);
  } else {
    const std::size_t first = (7 * c.number + 3) % count;
    chosen = {first, (first + count / 2) % count};
  }
  return chosen;
}

}  // namespace facet::test
