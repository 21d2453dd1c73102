// Every BSDF of the shared list, on the kernels: what they sample has the density that they say, gains no
// energy and is reciprocal; values and weights are those of the reference in double. FACET_FULL_GRID in the
// environment samples every direction.
#include <cmath>

#include "reference/bsdf_evaluator.h"
#include "render/bsdf_evaluator.h"
#include "statistics/chi2_harness.h"
#include "statistics/hypothesis.h"
#include "support/bsdf_cases.h"
#include "support/render.h"

namespace facet::test {
namespace {

using statistics::BsdfDraw;
using statistics::BsdfNumbers;
using statistics::BsdfValue;
using statistics::DirectionPair;

gpu::Device& device() {
  static gpu::Device device = make_device();
  return device;
}

KernelBsdfEvaluator kernels_of(const BsdfCase& c) {
  static BsdfKernels kernels(device());
  return {kernels, c.bsdf, c.sampling};
}

/// Significance of one chi-squared test, so that all of the file err together with probability 0.01.
double chi2_significance() {
  std::uint64_t tests = 0;
  for (std::size_t id = 0; id < bsdf_type_names.size(); ++id) {
    for (const BsdfCase& c : bsdf_cases(id)) tests += sampled_directions(c, view_directions(c).size()).size();
  }
  return statistics::sidak_significance(0.01, tests);
}

std::string describe(const BsdfCase& c, const vec3& wo) {
  return fmt::format("{}, wo ({}, {}, {})", c.name, wo.x, wo.y, wo.z);
}

/// Largest mean weight that is no gain. That of roughsubstrate from the denser side is inherent in its
/// formula, and fresnelblend has no masking (below).
double largest_albedo(const BsdfCase& c) {
  const auto* substrate = std::get_if<bsdf::RoughSubstrate>(&c.bsdf);
  if (substrate != nullptr && substrate->ext_ior > substrate->int_ior) return 1.9;
  if (std::holds_alternative<bsdf::FresnelBlend>(c.bsdf)) return 1e9;
  return 1;
}

void expect_no_gain(const BsdfCase& c, const vec3& wo, const statistics::MeanWeight& weight) {
  for (int k = 0; k < 3; ++k) {
    EXPECT_LE(weight.mean[k], largest_albedo(c) * (1 + 1e-6) + 5 * weight.error[k])
        << describe(c, wo) << ", channel " << k;
  }
}

class BsdfTest : public testing::TestWithParam<std::size_t> {
 protected:
  void TearDown() override { expect_silent_validation(); }
};

TEST_P(BsdfTest, samples_have_their_density_and_gain_no_energy) {
  const double significance = chi2_significance();
  double least = 1;
  for (const BsdfCase& c : bsdf_cases(GetParam())) {
    KernelBsdfEvaluator kernels = kernels_of(c);
    const std::vector<vec3> directions = view_directions(c);
    for (const std::size_t d : sampled_directions(c, directions.size())) {
      const vec3 wo = directions[d];
      statistics::Chi2Options options;
      options.seed = static_cast<std::uint32_t>(2 * (100 * c.number + d));
      options.transmission_scale = static_cast<float>(std::pow(c.index_at(-wo) / c.index_at(wo), 2));
      const statistics::Chi2Result r = statistics::test_sampling(kernels, wo, options, significance);
      EXPECT_EQ(r.fault, "") << describe(c, wo);
      EXPECT_EQ(r.deltas.empty(), !c.has_flag(shared::BSDF_DELTA) && r.pdf_integral > 0) << describe(c, wo);
      if (r.deltas.empty()) {
        const double error = std::sqrt(r.rejected_share * (1 - r.rejected_share) / options.samples);
        EXPECT_NEAR(r.pdf_integral, 1 - r.rejected_share, 5 * error + r.integral_error) << describe(c, wo);
      }
      expect_no_gain(c, wo, r.weight);
      least = std::min(least, r.p_value);
    }
  }
  std::printf("least p-value %.3g, significance %.3g\n", least, significance);
}

/// How much worse than single precision a value near its lobe's flank is: D moves by 2 tan^2/alpha^2 times
/// the relative error of tan.
double conditioning(const BsdfCase& c, const DirectionPair& p) {
  const bool reflects = (p.wo.z > 0) == (p.wi.z > 0);
  const double eta_o = reflects ? 1 : c.index_at(p.wo);
  const double eta_i = reflects ? 1 : c.index_at(p.wi);
  const dvec3 h = dvec3(p.wo) * eta_o + dvec3(p.wi) * eta_i;
  const double tan2 = (h.x * h.x + h.y * h.y) / (h.z * h.z);
  return std::max(1.0, tan2 / (static_cast<double>(c.alpha()) * c.alpha()) / 10);
}

/// Pairs to evaluate: samples, which lie in the lobes, and directions all over the sphere.
std::vector<DirectionPair> pairs_of(const BsdfCase& c, KernelBsdfEvaluator& kernels) {
  std::vector<DirectionPair> pairs;
  const std::vector<vec3> directions = view_directions(c);
  for (std::size_t d = 0; d < directions.size(); ++d) {
    for (const BsdfDraw& draw :
         kernels.sample(directions[d], 192, static_cast<std::uint32_t>(c.number + d))) {
      if (draw.weight != vec3(0) && draw.pdf > 0) pairs.push_back({directions[d], draw.wi});
    }
    for (const vec3& wi : directions) pairs.push_back({directions[d], {wi.y, -wi.x, wi.z}});
  }
  return pairs;
}

bool is_value(const BsdfValue& v) {
  return std::isfinite(v.pdf) && v.pdf >= 0 && std::isfinite(v.f.x + v.f.y + v.f.z) &&
         glm::all(glm::greaterThanEqual(v.f, vec3(0)));
}

/// Relative difference in units of what is allowed.
class Comparison {
 public:
  void add(double a, double b, double allowed, const std::string& where) {
    const double largest = std::max(std::abs(a), std::abs(b));
    // Below, D is all but gone: kernels cut it at e^-87.
    if (largest < 1e-25) return;
    const double share = std::abs(a - b) / largest / allowed;
    if (share > worst_) worst_ = share, where_ = fmt::format("{}: {} and {}", where, a, b);
    ++count_;
  }
  void expect(std::size_t least_count) const {
    EXPECT_LE(worst_, 1) << where_;
    EXPECT_GE(count_, least_count);
    std::printf("worst difference %.3f of what is allowed, of %zu: %s\n", worst_, count_, where_.c_str());
  }

 private:
  double worst_ = 0;
  std::size_t count_ = 0;
  std::string where_;
};

TEST_P(BsdfTest, values_are_those_of_the_reference) {
  Comparison values;
  bool smooth = false;
  for (const BsdfCase& c : bsdf_cases(GetParam())) {
    KernelBsdfEvaluator kernels = kernels_of(c);
    reference::ReferenceBsdfEvaluator<double> reference(c.bsdf, c.sampling);
    const std::vector<DirectionPair> pairs = pairs_of(c, kernels);
    const std::vector<BsdfValue> found = kernels.evaluate(pairs);
    const std::vector<BsdfValue> right = reference.evaluate(pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const std::string where = describe(c, pairs[i].wo) +
                                fmt::format(", wi ({}, {}, {})", pairs[i].wi.x, pairs[i].wi.y, pairs[i].wi.z);
      EXPECT_TRUE(is_value(found[i])) << where;
      const double allowed = 1e-5 * conditioning(c, pairs[i]);
      for (int k = 0; k < 3; ++k) values.add(found[i].f[k], right[i].f[k], allowed, where + " value");
      values.add(found[i].pdf, right[i].pdf, allowed, where + " density");
    }
    smooth = smooth || (!found.empty() && found[0].pdf == 0 && c.has_flag(shared::BSDF_DELTA));
  }
  values.expect(smooth ? 0 : 1000);
}

TEST_P(BsdfTest, values_are_reciprocal) {
  Comparison values;
  for (const BsdfCase& c : bsdf_cases(GetParam())) {
    // Compensation is by wo's albedo alone.
    if (c.has_flag(shared::BSDF_MULTISCATTER)) continue;
    KernelBsdfEvaluator kernels = kernels_of(c);
    const std::vector<DirectionPair> pairs = pairs_of(c, kernels);
    std::vector<DirectionPair> swapped;
    for (const DirectionPair& p : pairs) swapped.push_back({p.wi, p.wo});
    const std::vector<BsdfValue> there = kernels.evaluate(pairs);
    const std::vector<BsdfValue> back = kernels.evaluate(swapped);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const double eta2_o = std::pow(c.index_at(pairs[i].wo), 2);
      const double eta2_i = std::pow(c.index_at(pairs[i].wi), 2);
      for (int k = 0; k < 3; ++k) {
        values.add(there[i].f[k] / eta2_o, back[i].f[k] / eta2_i, 2e-5 * conditioning(c, pairs[i]),
                   describe(c, pairs[i].wo) +
                       fmt::format(", wi ({}, {}, {})", pairs[i].wi.x, pairs[i].wi.y, pairs[i].wi.z));
      }
    }
  }
  values.expect(0);
}

/// Every combination of the least, a middling and the largest number.
std::vector<BsdfNumbers> extreme_numbers() {
  std::vector<BsdfNumbers> numbers;
  for (const float lobe : {0.0F, 0.5F, 1 - 0x1p-24F}) {
    for (const float u : {0.0F, 0.5F, 1 - 0x1p-24F}) {
      for (const float v : {0.0F, 0.5F, 1 - 0x1p-24F}) numbers.push_back({lobe, u, v});
    }
  }
  return numbers;
}

TEST_P(BsdfTest, weights_are_value_times_cosine_over_density) {
  Comparison weights;
  const std::vector<BsdfNumbers> extremes = extreme_numbers();
  for (const BsdfCase& c : bsdf_cases(GetParam())) {
    KernelBsdfEvaluator kernels = kernels_of(c);
    for (const vec3& wo : view_directions(c)) {
      std::vector<BsdfDraw> draws = kernels.sample(wo, 512, static_cast<std::uint32_t>(c.number + 7));
      for (const BsdfDraw& d : kernels.sample(wo, extremes)) draws.push_back(d);
      std::vector<DirectionPair> pairs;
      for (const BsdfDraw& d : draws) pairs.push_back({wo, d.wi});
      const std::vector<BsdfValue> values = kernels.evaluate(pairs);
      for (std::size_t i = 0; i < draws.size(); ++i) {
        const BsdfDraw& d = draws[i];
        ASSERT_TRUE(is_value({d.weight, std::max(d.pdf, 0.0F)})) << describe(c, wo) << ", sample " << i;
        if (d.weight == vec3(0) || d.pdf < 0) continue;
        EXPECT_NEAR(glm::length(dvec3(d.wi)), 1, 1e-6) << describe(c, wo);
        if (!(values[i].pdf > 1e-20F)) continue;
        const double scale = std::abs(static_cast<double>(d.wi.z)) / values[i].pdf;
        for (int k = 0; k < 3; ++k)
          weights.add(d.weight[k], values[i].f[k] * scale, 1e-4 * conditioning(c, pairs[i]),
                      describe(c, wo) + fmt::format(", sample {}", i));
      }
    }
  }
  weights.expect(0);
}

std::string name_of(const testing::TestParamInfo<std::size_t>& info) {
  return std::string(bsdf_type_names[info.param]);
}

INSTANTIATE_TEST_SUITE_P(Every, BsdfTest, testing::Range<std::size_t>(0, bsdf_type_names.size()), name_of);

}  // namespace
}  // namespace facet::test
