// Every BSDF of the shared list, on the kernels: what they sample has the density that they say,
// and gains no energy. With FACET_FULL_GRID in the environment, seen from every direction, and with
// twice the samples.
#include <cmath>

#include "statistics/chi2_harness.h"
#include "statistics/hypothesis.h"
#include "support/bsdf_kernels.h"

namespace facet::test {
namespace {

using statistics::BsdfDraw;

/// Significance of one chi-squared test, so that all of the file err together with probability
/// 0.01.
double chi2_significance() {
  std::uint64_t tests = 0;
  for (std::size_t id = 0; id < bsdf_type_names.size(); ++id) {
    for (const BsdfCase& c : bsdf_cases(id))
      tests += sampled_directions(c, view_directions(c).size()).size();
  }
  return statistics::sidak_significance(0.01, tests);
}

/// Largest mean weight that is no gain. Tables of albedos are interpolated; that of roughsubstrate
/// from the denser side is inherent in its formula.
double largest_albedo(const BsdfCase& c) {
  const auto* substrate = std::get_if<bsdf::RoughSubstrate>(&c.bsdf);
  if (substrate != nullptr && substrate->ext_ior > substrate->int_ior) return 1.9;
  if (c.has_flag(shared::BSDF_MULTISCATTER)) return 1.005;
  return 1;
}

void expect_no_gain(const BsdfCase& c, const vec3& wo, const statistics::MeanWeight& weight) {
  for (int k = 0; k < 3; ++k) {
    EXPECT_LE(weight.mean[k], largest_albedo(c) * (1 + 1e-6) + 5 * weight.error[k])
        << describe(c, wo) << ", channel " << k;
  }
}

TEST_P(BsdfTest, samples_have_their_density_and_gain_no_energy) {
  const double significance = chi2_significance();
  double least = 1;
  dvec3 brightest(0);
  for (const BsdfCase& c : bsdf_cases(GetParam())) {
    KernelBsdfEvaluator kernels = kernels_of(c);
    const std::vector<vec3> directions = view_directions(c);
    for (const std::size_t d : sampled_directions(c, directions.size())) {
      const vec3 wo = directions[d];
      statistics::Chi2Options options;
      if (!full_grid()) options.samples /= 2;
      options.seed = static_cast<std::uint32_t>(2 * (100 * c.number + d));
      options.transmission_scale =
          static_cast<float>(std::pow(c.index_at(-wo) / c.index_at(wo), 2));
      const statistics::Chi2Result r =
          statistics::test_sampling(kernels, wo, options, significance);
      EXPECT_EQ(r.fault, "") << describe(c, wo);
      EXPECT_EQ(r.deltas.empty(), !c.has_flag(shared::BSDF_DELTA) && r.pdf_integral > 0)
          << describe(c, wo);
      if (r.deltas.empty()) {
        const double error = std::sqrt(r.rejected_share * (1 - r.rejected_share) / options.samples);
        EXPECT_NEAR(r.pdf_integral, 1 - r.rejected_share, 5 * error + r.integral_error)
            << describe(c, wo);
      }
      expect_no_gain(c, wo, r.weight);
      least = std::min(least, r.p_value);
      brightest = glm::max(brightest, r.weight.mean);
    }
  }
  std::printf("least p-value %.3g, significance %.3g, largest albedo %.4f\n", least, significance,
              std::max({brightest.x, brightest.y, brightest.z}));
}

/// Reflectance between dielectrics by the amplitudes, in double.
double exact_fresnel(double cosine, double ratio) {
  const double sin2 = (1 - cosine * cosine) * ratio * ratio;
  if (sin2 >= 1) return 1;
  const double beyond = std::sqrt(1 - sin2);
  const double s = (ratio * cosine - beyond) / (ratio * cosine + beyond);
  const double p = (cosine - ratio * beyond) / (cosine + ratio * beyond);
  return 0.5 * (s * s + p * p);
}

TEST(DeltaLobes, dielectric_reflects_as_often_as_fresnel_says) {
  int tests = 0;
  double least = 1;
  for (const BsdfCase& c : bsdf_cases(Bsdf(bsdf::Dielectric{}).index())) {
    KernelBsdfEvaluator kernels = kernels_of(c);
    for (const vec3& wo : view_directions(c)) {
      const double f =
          exact_fresnel(std::abs(static_cast<double>(wo.z)), c.index_at(wo) / c.index_at(-wo));
      constexpr std::uint32_t samples = 100'000;
      double reflected = 0;
      for (const BsdfDraw& d : kernels.sample(wo, samples, static_cast<std::uint32_t>(++tests))) {
        if ((d.wi.z > 0) == (wo.z > 0)) ++reflected;
      }
      const double deviation = std::sqrt(std::max(samples * f * (1 - f), 1.0));
      least = std::min(least, statistics::normal_p_value((reflected - samples * f) / deviation));
    }
  }
  EXPECT_GE(tests, 100);
  EXPECT_GE(least, statistics::sidak_significance(0.01, static_cast<std::uint64_t>(tests)));
}

INSTANTIATE_TEST_SUITE_P(Every, BsdfTest, testing::Range<std::size_t>(0, bsdf_type_names.size()),
                         name_of);

}  // namespace
}  // namespace facet::test
