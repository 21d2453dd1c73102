// Albedos of the rough BSDFs where they absorb nothing, by angle and roughness, on the kernels: no
// model makes light. FACET_ALBEDO_PAGE=docs/reference/albedo.md in the environment writes them
// down.
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "render/kernel_bsdf_evaluator.h"
#include "support/bsdf_cases.h"
#include "support/render.h"

namespace facet::test {
namespace {

struct Albedo {
  double mean = 0;
  double error = 0;
};

/// A model that absorbs nothing, and the largest and least albedos that its formula has.
struct Model {
  std::string title;
  Bsdf bsdf;
  double largest = 1;
  double least = 0;
};

constexpr std::array cosines{1.0F, 0.9F, 0.7F, 0.5F, 0.3F, 0.1F, 0.03F};

template <typename T>
Bsdf with(T parameters, bsdf::Distribution distribution, float alpha) {
  parameters.options.distribution = distribution;
  parameters.alpha = alpha;
  return parameters;
}

std::vector<Model> models(bsdf::Distribution d, float alpha) {
  const Color white(1);
  bsdf::RoughConductor compensated{white};
  compensated.multiscatter = true;
  return {{"`roughconductor`, R0 = 1", with(bsdf::RoughConductor{white}, d, alpha)},
          {"`roughconductor`, R0 = 1, `multiscatter`", with(compensated, d, alpha), 1.001, 0.999},
          {"`roughdielectric`, indices 1 and 1.5, from outside",
           with(bsdf::RoughDielectric{white, 0.1F, 1, 1.5F}, d, alpha)},
          {"`roughdielectric`, indices 1 and 1.5, from inside",
           with(bsdf::RoughDielectric{white, 0.1F, 1.5F, 1}, d, alpha)},
          {"`roughsubstrate`, kd = 1, indices 1 and 1.5",
           with(bsdf::RoughSubstrate{white, 0.1F, 1, 1.5F}, d, alpha)},
          {"`microfacet`, kd = 0.5, indices 1 and 1.5",
           with(bsdf::Microfacet{0.1F, 1, 1.5F, Color(0.5F)}, d, alpha)},
          {"`fresnelblend`, Rd = 1, Rs = 0.05",
           with(bsdf::FresnelBlend{white, Color(0.05F)}, d, alpha)},
          {"`fresnelblend`, Rd = 0, Rs = 1", with(bsdf::FresnelBlend{Color(0), white}, d, alpha)}};
}

/// Mean weight of 2^17 samples, radiance's scaling by refraction taken out.
Albedo measure(KernelBsdfEvaluator& kernels, const Bsdf& bsdf, float cosine) {
  const BsdfCase scale{bsdf, LobeSampling::visible, "", 0};
  const vec3 wo(std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine);
  const double crossing =
      scale.transmits() ? std::pow(scale.index_at(-wo) / scale.index_at(wo), 2) : 1;
  double sum = 0;
  double squares = 0;
  constexpr std::uint32_t samples = 1U << 17U;
  for (const statistics::BsdfDraw& d : kernels.sample(wo, samples, 77)) {
    const double w = static_cast<double>(d.weight.x) * (d.wi.z < 0 ? crossing : 1.0);
    sum += w;
    squares += w * w;
  }
  const double mean = sum / samples;
  return {mean, std::sqrt(std::max(0.0, squares / samples - mean * mean) / samples)};
}

std::string table_of(BsdfKernels& kernels, std::size_t model, bsdf::Distribution distribution) {
  std::string text = fmt::format("| {}, α \\ cos θo |",
                                 distribution == bsdf::Distribution::ggx ? "GGX" : "Beckmann");
  std::string rule = "|---|";
  for (const float c : cosines) text += fmt::format(" {} |", c), rule += "---|";
  text += "\n" + rule + "\n";
  for (const float alpha : roughnesses) {
    const Model m = models(distribution, alpha)[model];
    KernelBsdfEvaluator evaluator(kernels, m.bsdf, LobeSampling::visible);
    text += fmt::format("| {} |", alpha);
    for (const float c : cosines) {
      const Albedo a = measure(evaluator, m.bsdf, c);
      EXPECT_LE(a.mean, m.largest + 1e-6 + 5 * a.error)
          << m.title << ", alpha " << alpha << ", cosine " << c;
      EXPECT_GT(a.mean, 0) << m.title;
      EXPECT_GE(a.mean, m.least - 5 * a.error)
          << m.title << ", alpha " << alpha << ", cosine " << c;
      text += fmt::format(" {:.3f} |", a.mean);
    }
    text += "\n";
  }
  return text + "\n";
}

TEST(Albedo, what_absorbs_nothing_makes_no_light) {
  BsdfKernels kernels(device());
  std::string page =
      "# Albedos\n\n"
      "Share of the light that each rough BSDF gives back where its parameters absorb nothing, by "
      "roughness "
      "and angle of view: mean\n"
      "weights of 2^17 samples of visible normals, standard errors below 0.002. Below 1 is what "
      "single "
      "scattering loses between\n"
      "microfacets. `multiscatter` is within 0.001 of 1, its tables being interpolated. "
      "`fresnelblend`, "
      "which has no masking, still\n"
      "gains nothing, since it divides by the larger cosine. Written by\n\n"
      "    FACET_ALBEDO_PAGE=docs/reference/albedo.md build/release/tests/albedo_test\n\n";
  const std::vector<Model> list = models(bsdf::Distribution::beckmann, 0.1F);
  for (std::size_t i = 0; i < list.size(); ++i) {
    page += "## " + list[i].title + "\n\n";
    page += table_of(kernels, i, bsdf::Distribution::beckmann) +
            table_of(kernels, i, bsdf::Distribution::ggx);
  }
  expect_silent_validation();
  if (const char* file = std::getenv("FACET_ALBEDO_PAGE"))
    std::ofstream(file) << page.substr(0, page.size() - 1);
}

}  // namespace
}  // namespace facet::test
