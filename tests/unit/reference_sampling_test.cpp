// Sampling of the reference's BSDFs against their values, by quadrature and sample by sample.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/bsdfs.h"

namespace facet::test {
namespace {

using namespace reference;
using Direction = Vec3<double>;

constexpr std::array options_to_test{rational_beckmann, exact_beckmann, ggx};
constexpr std::array strategies{LobeSampling::visible, LobeSampling::ndf, LobeSampling::uniform};

/// Integrals over the sphere, by the midpoint rule in cos(theta) and phi.
struct Integrals {
  Direction albedo{0};
  double pdf = 0;
};

Integrals integrate(const AnyBsdf<double>& bsdf, const Direction& wo) {
  constexpr int rows = 300;
  constexpr int turns = 200;
  Unwatched probe;
  Integrals sum;
  for (int i = 0; i < 2 * rows; ++i) {
    const double z = (i + 0.5) / rows - 1;
    const double r = std::sqrt((1 - z) * (1 + z));
    for (int k = 0; k < turns; ++k) {
      // Half a turn: all lobes are symmetric about the plane of incidence.
      const double phi = std::atan2(wo.y, wo.x) + std::numbers::pi * (k + 0.5) / turns;
      const Direction wi(r * std::cos(phi), r * std::sin(phi), z);
      sum.albedo += bsdf.eval(wo, wi, probe) * std::abs(z);
      sum.pdf += bsdf.pdf(wo, wi, probe);
    }
  }
  const double cell = 2 * std::numbers::pi / turns / rows;
  return {sum.albedo * cell, sum.pdf * cell};
}

/// Calls use(sample) for a grid of numbers, the last choice's by a sequence of low discrepancy.
template <typename Use>
int for_each_sample(const AnyBsdf<double>& bsdf, const Direction& wo, int side, const Use& use) {
  Unwatched probe;
  for (int i = 0; i < side * side; ++i) {
    const double lobe = std::fmod(i * 0.6180339887498949, 1.0);
    use(bsdf.sample(wo, numbers(lobe, (i % side + 0.5) / side, (i / side + 0.5) / side), probe));
  }
  return side * side;
}

/// Directions from above, and from below where the surface transmits.
std::vector<Direction> views(const NamedBsdf& b) {
  std::vector<Direction> list{direction(0.2, 1), direction(1.2, 2)};
  if (b.name == "roughdielectric") list.insert(list.end(), {direction(2.9, 1), direction(2.0, 2)});
  return list;
}

TEST(ReferenceSampling, samples_have_the_density_and_the_albedo_of_the_lobe) {
  for (const bsdf::MicrofacetOptions& options : options_to_test) {
    for (const NamedBsdf& b : rough_bsdfs(0.4F, options)) {
      for (const Direction& wo : views(b)) {
        for (const LobeSampling strategy : strategies) {
          const auto model = make_bsdf<double>(b.bsdf, strategy, wo.z < 0);
          const Integrals expected = integrate(model, wo);
          Integrals mean;
          const int count = for_each_sample(model, wo, 128, [&](const BsdfSample<double>& s) {
            mean.albedo += s.weight;
            mean.pdf += s.pdf > 0 ? 1 : 0;
          });
          const std::string what =
              fmt::format("{} z {} strategy {}", b.name, wo.z, static_cast<int>(strategy));
          // What is rejected has no density.
          EXPECT_NEAR(mean.pdf / count, expected.pdf, 4e-3) << what;
          // The other strategies leave more to the weight.
          const double share = strategy == LobeSampling::visible ? 4e-3 : 8e-3;
          for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(mean.albedo[k] / count, expected.albedo[k],
                        share * (1 + expected.albedo[k]))
                << what;
        }
      }
    }
  }
}

TEST(ReferenceSampling, weights_are_values_over_densities) {
  Unwatched probe;
  for (const bsdf::MicrofacetOptions& options : options_to_test) {
    for (const float alpha : {0.01F, 0.4F}) {
      for (const NamedBsdf& b : rough_bsdfs(alpha, options)) {
        for (const Direction& wo : views(b)) {
          for (const LobeSampling strategy : strategies) {
            const auto model = make_bsdf<double>(b.bsdf, strategy, wo.z < 0);
            int tested = 0;
            for_each_sample(model, wo, 50, [&](const BsdfSample<double>& s) {
              // Where D ends, one of two half vectors may lie beyond.
              if (!(s.pdf > 1e-30) || s.weight == Direction(0)) return;
              const double pdf = model.pdf(wo, s.wi, probe);
              const Direction value = model.eval(wo, s.wi, probe);
              ++tested;
              ASSERT_NEAR(s.pdf / pdf, 1, 1e-7) << b.name;
              ASSERT_NEAR(s.weight.x * s.pdf / (value.x * std::abs(s.wi.z)), 1, 1e-7) << b.name;
              const bool crossed = s.wi.z * wo.z < 0;
              EXPECT_NEAR(s.eta2, crossed ? (wo.z > 0 ? 2.25 : 1 / 2.25) : 1, 1e-7);
            });
            EXPECT_GE(tested, strategy == LobeSampling::uniform ? 1 : 1200) << b.name;
          }
        }
      }
    }
  }
}

TEST(ReferenceSampling, no_surface_gives_more_light_than_it_gets) {
  const Color white(1);
  for (const bsdf::MicrofacetOptions& options : options_to_test) {
    for (const float alpha : {0.01F, 0.3F, 1.0F}) {
      const std::vector<Bsdf> bsdfs{bsdf::Diffuse{white},
                                    bsdf::Mirror{},
                                    bsdf::Dielectric{1, 1.5F},
                                    bsdf::RoughConductor{white, alpha, options},
                                    bsdf::RoughSubstrate{white, alpha, 1, 1.5F, options},
                                    bsdf::Microfacet{alpha, 1, 1.5F, Color(0.5F), options},
                                    bsdf::FresnelBlend{white, Color(0.3F), alpha, options},
                                    bsdf::RoughDielectric{white, alpha, 1, 1.5F, options},
                                    bsdf::RoughDielectric{white, alpha, 1.5F, 1, options}};
      for (const Bsdf& b : bsdfs) {
        for (const double theta : {0.01, 0.8, 1.3, 1.5}) {
          const auto model = make_bsdf<double>(b, LobeSampling::visible);
          double light = 0;
          // eta^2: what refraction does to radiance it does to no energy.
          const int count =
              for_each_sample(model, direction(theta, 1), 64,
                              [&](const BsdfSample<double>& s) { light += s.weight.x * s.eta2; });
          EXPECT_LE(light / count, 1.004)
              << bsdf_type_names.at(b.index()) << ' ' << alpha << ' ' << theta;
          EXPECT_GE(light / count, 0.15)
              << bsdf_type_names.at(b.index()) << ' ' << alpha << ' ' << theta;
        }
      }
    }
  }
}

TEST(ReferenceSampling, a_dielectric_reflects_by_fresnel_and_refracts_by_snell) {
  Unwatched probe;
  const Bsdf glass = bsdf::Dielectric{1, 1.5F};
  for (const double theta : {0.0, 0.5, 1.0, 1.4, 1.57, 1.7, 2.4, 2.6, 3.0}) {
    const Direction wo = direction(theta, 0.7);
    const auto model = make_bsdf<double>(glass, LobeSampling::visible, wo.z < 0);
    ASSERT_TRUE(model.delta() && model.transmits());
    const double outer = wo.z > 0 ? 1 : 1.5;
    const double inner = 2.5 - outer;
    const double f = dielectric_shares(std::abs(wo.z), outer, inner, 0, probe).reflected;
    const BsdfSample<double> reflected = model.sample(wo, numbers(0, 0, 0), probe);
    EXPECT_EQ(reflected.wi, Direction(-wo.x, -wo.y, wo.z));
    EXPECT_EQ(reflected.weight, Direction(1));
    EXPECT_EQ(reflected.pdf, delta_pdf<double>);
    EXPECT_EQ(model.sample(wo, numbers(0, f - 0x1p-32, 0), probe).wi, reflected.wi) << "below F";
    EXPECT_EQ(model.eval(wo, reflected.wi, probe), Direction(0));
    EXPECT_EQ(model.pdf(wo, reflected.wi, probe), 0);
    if (f >= 1) continue;
    const BsdfSample<double> refracted = model.sample(wo, numbers(0, f, 0), probe);
    EXPECT_LT(refracted.wi.z * wo.z, 0);
    EXPECT_NEAR(glm::dot(refracted.wi, refracted.wi), 1, 1e-12);
    EXPECT_NEAR(inner * refracted.wi.x, -outer * wo.x, 1e-12);
    EXPECT_NEAR(inner * refracted.wi.y, -outer * wo.y, 1e-12);
    EXPECT_NEAR(refracted.weight.x, outer * outer / (inner * inner), 1e-12);
    EXPECT_NEAR(refracted.eta2 * refracted.weight.x, 1, 1e-12);
    // The way back is the same.
    const auto back = make_bsdf<double>(glass, LobeSampling::visible, refracted.wi.z < 0);
    const BsdfSample<double> out = back.sample(refracted.wi, numbers(0, 1 - 1e-9, 0), probe);
    EXPECT_NEAR(glm::length(out.wi - wo), 0, 1e-9);
  }
}

TEST(ReferenceSampling, equal_indices_bend_nothing) {
  Unwatched probe;
  const Direction wo = direction(1.1, 0.4);
  const auto smooth = make_bsdf<double>(bsdf::Dielectric{1.3F, 1.3F}, LobeSampling::visible);
  const BsdfSample<double> through = smooth.sample(wo, numbers(0, 0, 0), probe);
  EXPECT_NEAR(glm::length(through.wi + wo), 0, 1e-12);
  EXPECT_EQ(through.weight, Direction(1));
  const Bsdf frosted = bsdf::RoughDielectric{Color(0.5F), 0.6F, 1.3F, 1.3F, exact_beckmann};
  const auto rough = make_bsdf<double>(frosted, LobeSampling::ndf);
  ASSERT_TRUE(rough.delta());
  const BsdfSample<double> s = rough.sample(wo, numbers(0.9, 0.3, 0.3), probe);
  EXPECT_EQ(s.wi, -wo);
  EXPECT_EQ(s.pdf, delta_pdf<double>);
  const Microfacets<double> microfacets(static_cast<double>(0.6F), exact_beckmann,
                                        LobeSampling::ndf);
  EXPECT_NEAR(s.weight.x, 0.5 * microfacets.exact_masking(wo), 1e-12);
  EXPECT_EQ(rough.eval(wo, -wo, probe), Direction(0));
  // The limit of indices that are nearly equal.
  const Bsdf near = bsdf::RoughDielectric{Color(0.5F), 0.6F, 1.3F, 1.3001F, exact_beckmann};
  const auto model = make_bsdf<double>(near, LobeSampling::visible);
  double sum = 0;
  const int count = for_each_sample(model, wo, 128, [&](const BsdfSample<double>& n) {
    sum += n.weight.x;
    if (n.weight.x > 0 && n.wi.z < 0) {
      EXPECT_NEAR(glm::length(n.wi + wo), 0, 0.03);
    }
  });
  EXPECT_NEAR(sum / count, s.weight.x, 2e-3);
}

template <typename Real>
void expect_sound(const Vec3<Real>& v, const std::string& what) {
  for (int k = 0; k < 3; ++k)
    EXPECT_TRUE(v[k] >= 0 && v[k] <= std::numeric_limits<Real>::max()) << what << v[k];
}

/// Every BSDF at the ends of its parameters.
std::vector<NamedBsdf> extreme_bsdfs() {
  std::vector<NamedBsdf> list;
  for (const float alpha : {1e-4F, 0.02F, 1.0F}) {
    for (const bsdf::MicrofacetOptions& options : options_to_test) {
      for (const auto& [outer, inner] :
           {std::pair{1.0F, 1.5F}, {1.5F, 1.0F}, {1.5F, 1.5F}, {1.0F, 1.00001F}}) {
        for (NamedBsdf& b : rough_bsdfs(alpha, options, outer, inner)) list.push_back(std::move(b));
        list.push_back({"dielectric", bsdf::Dielectric{outer, inner}});
        for (const float c : {0.0F, 1.0F}) {
          const Color color(c);
          list.push_back(
              {"roughsubstrate", bsdf::RoughSubstrate{color, alpha, outer, inner, options}});
          list.push_back({"microfacet", bsdf::Microfacet{alpha, outer, inner, color, options}});
          list.push_back({"fresnelblend", bsdf::FresnelBlend{color, color, alpha, options}});
          list.push_back(
              {"fresnelblend", bsdf::FresnelBlend{Color(1) - color, color, alpha, options}});
          list.push_back({"roughconductor", bsdf::RoughConductor{color, alpha, options, c > 0}});
        }
      }
    }
  }
  return list;
}

template <typename Real>
void expect_sound_at_the_ends() {
  constexpr double end = 1 - 0x1p-32;
  Unwatched probe;
  std::vector<Vec3<Real>> wos;
  for (const double z : {1e-7, 1e-3, 0.7, 1.0})
    for (const double sign : {1.0, -1.0}) wos.emplace_back(direction(std::acos(sign * z), 0.3));
  for (const NamedBsdf& b : extreme_bsdfs()) {
    for (const Vec3<Real>& wo : wos) {
      for (const LobeSampling strategy : strategies) {
        const auto model = make_bsdf<Real>(b.bsdf, strategy, wo.z < 0);
        if (wo.z < 0 && !model.transmits()) continue;
        const auto check_pair = [&](const Vec3<Real>& wi) {
          expect_sound(model.eval(wo, wi, probe) * std::abs(wi.z), b.name + " value ");
          expect_sound(Vec3<Real>(model.pdf(wo, wi, probe)), b.name + " density ");
        };
        for (const double lobe : {0.0, 0.5, end}) {
          for (const double u : {0.0, 0x1p-24, 0.1, 0.5, 0.9, end}) {
            for (const double v : {0.0, 0.3, end}) {
              const BsdfSample<Real> s = model.sample(wo, numbers(lobe, u, v), probe);
              expect_sound(s.weight, b.name + " weight ");
              if (s.pdf != delta_pdf<Real>)
                expect_sound(Vec3<Real>(s.pdf), b.name + " sample's density ");
              if (s.weight != Vec3<Real>(0)) check_pair(s.wi);
            }
          }
        }
        for (const Vec3<Real>& wi : wos) check_pair(wi);
        check_pair(-wo);
        check_pair({-wo.x, -wo.y, wo.z});
      }
    }
  }
}

TEST(ReferenceSampling, nothing_breaks_at_the_ends_of_the_parameters) {
  expect_sound_at_the_ends<float>();
  expect_sound_at_the_ends<double>();
}

}  // namespace
}  // namespace facet::test
