// The kernels' elementary functions, on the device, against double precision. The bounds are the
// ones that shaders/lib/elementary.glsl states.
#include <cmath>
#include <fstream>
#include <numbers>

#include "gpu/commands.h"
#include "shared/random_hash.h"
#include "support/render.h"

namespace facet::test {
namespace {

enum Function : std::uint32_t {
  function_exp,
  function_log,
  function_sincos,
  function_atan2,
  function_erfc,
  function_erfinv,
  function_visible_slope,
  function_fresnel,
  function_quotient
};

using Pairs = std::vector<glm::vec2>;

std::vector<std::uint32_t> read_words(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  EXPECT_TRUE(in) << path;
  std::vector<std::uint32_t> words(static_cast<std::size_t>(in.tellg()) / 4);
  in.seekg(0);
  in.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
  return words;
}

/// outputs[i] = function(inputs[i]) by the kernel.
Pairs evaluate(Function function, const Pairs& inputs) {
  gpu::Buffer in(device(), inputs.size() * sizeof(glm::vec2), "inputs");
  const gpu::Buffer out(device(), inputs.size() * sizeof(glm::vec2), "outputs");
  in.upload(inputs);
  const gpu::Program program(device(), {{0, gpu::Access::storage}, {1, gpu::Access::storage}}, 4);
  const gpu::BoundBuffers bound = program.bind({{0, &in}, {1, &out}});
  const std::vector<std::uint32_t> constants{function};
  const gpu::CompiledKernel kernel =
      program.compile(read_words(FACET_TEST_KERNELS "/elementary.spv"), constants, "elementary");
  device().run([&](gpu::Commands& c) {
    c.bind(bound);
    c.dispatch(kernel, std::uint32_t{0}, static_cast<std::uint32_t>((inputs.size() + 63) / 64));
  });
  Pairs outputs(inputs.size());
  out.download(std::as_writable_bytes(std::span(outputs)));
  expect_silent_validation();
  return outputs;
}

constexpr std::size_t count = 1U << 20U;

Pairs sweep(double from, double to) {
  Pairs inputs(count);
  for (std::size_t i = 0; i < count; ++i) {
    inputs[i] = {static_cast<float>(from + (to - from) * static_cast<double>(i) / (count - 1)), 0};
  }
  return inputs;
}

Pairs sweep_exponents(double from, double to) {
  Pairs inputs = sweep(std::log(from), std::log(to));
  for (glm::vec2& x : inputs) x.x = static_cast<float>(std::exp(static_cast<double>(x.x)));
  return inputs;
}

/// Largest |y - expected| in units in the last place of the expected value.
template <typename Exact>
double largest_ulp(Function function, const Pairs& inputs, const Exact& exact) {
  const Pairs outputs = evaluate(function, inputs);
  double largest = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const double y = exact(static_cast<double>(inputs[i].x), static_cast<double>(inputs[i].y));
    const double ulp = std::ldexp(1.0, std::max(std::ilogb(y), -126) - 23);
    largest = std::max(largest, std::abs(static_cast<double>(outputs[i].x) - y) / ulp);
  }
  return largest;
}

// The remainder of a choice, in exact integers.
TEST(Elementary, quotient_of_64_bits) {
  for (const std::uint32_t kind : {0U, 1U}) {
    Pairs inputs(count);
    for (std::size_t i = 0; i < count; ++i)
      inputs[i] = {static_cast<float>(i), static_cast<float>(kind)};
    const Pairs outputs = evaluate(function_quotient, inputs);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const shared::uvec4 words = shared::pcg4d({i, 0, 0, 0});
      const std::uint64_t divisor = std::max(words.x >> (words.w & 31U), 1U);
      const std::uint64_t high = kind == 1 ? divisor - 1 : words.y % divisor;
      const std::uint64_t low = kind == 1 ? 0xffffffffU : words.z;
      const std::uint64_t quotient = ((high << 32U) + low) / divisor;
      if (outputs[i] !=
          glm::vec2(static_cast<float>(quotient >> 16U), static_cast<float>(quotient & 0xffffU)))
        ++wrong;
    }
    EXPECT_EQ(wrong, 0U) << kind;
  }
}

TEST(Elementary, exp) {
  EXPECT_LE(largest_ulp(function_exp, sweep(-87, 88), [](double x, double) { return std::exp(x); }),
            2);
  EXPECT_EQ(evaluate(function_exp, {{-1000, 0}})[0].x, 0);
  EXPECT_EQ(evaluate(function_exp, {{0, 0}})[0].x, 1);
}

TEST(Elementary, log) {
  const auto exact = [](double x, double) { return std::log(x); };
  EXPECT_LE(largest_ulp(function_log, sweep_exponents(1.2e-38, 3e38), exact), 1.5);
  // Near 1, where GLSL's own loses all digits on lavapipe.
  EXPECT_LE(largest_ulp(function_log, sweep(0.5, 2), exact), 1.5);
  EXPECT_EQ(evaluate(function_log, {{1, 0}})[0].x, 0);
}

TEST(Elementary, sine_and_cosine_of_turns) {
  const Pairs inputs = sweep(0, 1);
  const Pairs outputs = evaluate(function_sincos, inputs);
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(inputs[i].x);
    largest = std::max(largest, std::abs(static_cast<double>(outputs[i].x) - std::sin(angle)));
    largest = std::max(largest, std::abs(static_cast<double>(outputs[i].y) - std::cos(angle)));
  }
  EXPECT_LE(largest, 1.5e-7);
}

TEST(Elementary, atan2) {
  Pairs inputs = sweep(0, 1);
  for (glm::vec2& x : inputs) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(x.x) - std::numbers::pi;
    x = {static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle))};
  }
  EXPECT_LE(
      largest_ulp(function_atan2, inputs, [](double y, double x) { return std::atan2(y, x); }), 3);
  EXPECT_EQ(evaluate(function_atan2, {{0, 0}})[0].x, 0);
}

TEST(Elementary, erfc_keeps_its_tail) {
  Pairs inputs = sweep(-6, 9);
  for (const glm::vec2& x : sweep_exponents(1e-4, 9)) {
    inputs.push_back(x);
    inputs.push_back(-x);
  }
  const Pairs outputs = evaluate(function_erfc, inputs);
  double largest = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto x = static_cast<double>(inputs[i].x);
    largest = std::max(largest, std::abs(outputs[i].x / std::erfc(x) - 1) / (1 + x * x));
  }
  EXPECT_LE(largest, 5e-7);
}

TEST(Elementary, erfinv_inverts_erf) {
  Pairs inputs = sweep(0.001, 0.999);
  for (int e = -25; e < -3; ++e) inputs.emplace_back(std::ldexp(1.0F, e), 0.0F);
  for (int e = -24; e < -3; ++e) inputs.emplace_back(1 - std::ldexp(1.0F, e), 0.0F);
  const Pairs outputs = evaluate(function_erfinv, inputs);
  double largest = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto u = static_cast<double>(inputs[i].x);
    const double x = outputs[i].x;
    // Error of x by one Newton step: (erf(x) + 1 - 2u) / erf'(x).
    const double residual = x < 0 ? std::erfc(-x) - 2 * u : 2 * (1 - u) - std::erfc(x);
    const double step = residual / (2 / std::sqrt(std::numbers::pi) * std::exp(-x * x));
    if (std::abs(x) > 1e-6) largest = std::max(largest, std::abs(step / x));
  }
  EXPECT_LE(largest, 4e-7);
}

/// Cumulative distribution of the visible slopes at x, not normalised (docs/sampling.md).
double visible_cdf(double s, double c, double x) {
  return c * std::erfc(-x) + s / std::sqrt(std::numbers::pi) * std::exp(-x * x);
}

TEST(Elementary, visible_slopes_invert_their_distribution) {
  Pairs inputs;
  for (int i = 0; i < 1024; ++i) {
    // Cosines of view from 1 to 1e-7, in angle and in orders of magnitude.
    const double c =
        i % 2 == 0 ? std::cos(i / 1024.0 * std::numbers::pi / 2) : std::pow(10.0, -7.0 * i / 1024);
    for (int k = 0; k < 512; ++k)
      inputs.emplace_back(static_cast<float>(c), static_cast<float>((k + 0.37) / 512));
    for (int e = 2; e <= 25; ++e) inputs.emplace_back(static_cast<float>(c), std::ldexp(1.0F, -e));
    for (int e = 2; e <= 24; ++e)
      inputs.emplace_back(static_cast<float>(c), 1 - std::ldexp(1.0F, -e));
  }
  const Pairs outputs = evaluate(function_visible_slope, inputs);
  double largest = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto c = static_cast<double>(inputs[i].x);
    const double s = std::sqrt((1 - c) * (1 + c));
    const double upper = std::min(c / std::max(s, 1e-20), 6.0);
    const double u = visible_cdf(s, c, outputs[i].x) / visible_cdf(s, c, upper);
    largest = std::max(largest, std::abs(u - static_cast<double>(inputs[i].y)));
  }
  EXPECT_LE(largest, 2e-6);
}

/// Dielectric reflectance by the textbook's amplitudes, in double.
double exact_fresnel(double ci, double eta_t) {
  const double sin2_t = (1 - ci * ci) / (eta_t * eta_t);
  if (sin2_t >= 1) return 1;
  const double ct = std::sqrt(1 - sin2_t);
  const double rs = (ci - eta_t * ct) / (ci + eta_t * ct);
  const double rp = (eta_t * ci - ct) / (eta_t * ci + ct);
  return 0.5 * (rs * rs + rp * rp);
}

TEST(Elementary, dielectric_reflectance_keeps_its_digits_near_equal_indices) {
  for (const float eta : {1.0001F, 1.001F, 1.1F, 1.5F, 2.4F, 0.999F, 0.667F}) {
    Pairs inputs = sweep(1e-7, 1);
    for (glm::vec2& x : inputs) x.y = eta;
    const Pairs outputs = evaluate(function_fresnel, inputs);
    const double critical = eta < 1 ? std::sqrt(1 - static_cast<double>(eta) * eta) : 0;
    double largest = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      // Beside the critical angle the reflectance itself is ill-conditioned.
      if (std::abs(inputs[i].x - critical) < 0.02 && eta < 1) continue;
      const double exact = exact_fresnel(inputs[i].x, inputs[i].y);
      largest = std::max(largest, std::abs(outputs[i].x / exact - 1));
    }
    EXPECT_LE(largest, 1e-5) << eta;
  }
  EXPECT_EQ(evaluate(function_fresnel, {{0.3F, 1.0F}})[0].x, 0);
}

}  // namespace
}  // namespace facet::test
