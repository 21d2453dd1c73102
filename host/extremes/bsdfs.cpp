// Every BSDF of the shared list on the device, with parameters and directions at their extremes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "extremes/bench.h"
#include "extremes/bsdf_models.h"
#include "render/kernel_bsdf_evaluator.h"

namespace facet::extremes {

namespace {

using statistics::BsdfDraw;
using statistics::BsdfValue;
using statistics::DirectionPair;

constexpr std::size_t whole_pairs = 10'000'000;
constexpr std::size_t quick_pairs = 36'000;
/// Inputs that are measured at a time.
constexpr std::size_t batch = 1U << 15U;

std::string text(const vec3& v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z); }
std::string text(const BsdfCase& c, const DirectionPair& p) {
  return fmt::format("{}; wo {}, wi {}", c.name, text(p.wo), text(p.wi));
}

/// deviations[i] = deviation(i), by all threads.
template <typename Deviation>
std::vector<double> deviations_of(std::size_t count, const Deviation& deviation) {
  std::vector<double> deviations(count);
  parallel_for(count, 4096, [&](std::size_t begin, std::size_t end) {
    const ExactThread thread;
    for (std::size_t i = begin; i < end; ++i) deviations[i] = deviation(i);
  });
  return deviations;
}

/// Calls body(case, evaluator, random, count) for batches of the cases of a BSDF.
template <typename Body>
void for_each_batch(Bench& bench, std::size_t id, const Body& body) {
  const std::vector<BsdfCase> cases = bsdf_cases(id);
  const std::size_t each = (bench.quick() ? quick_pairs : whole_pairs) / cases.size();
  BsdfKernels kernels(bench.device());
  for (std::size_t k = 0; k < cases.size(); ++k) {
    KernelBsdfEvaluator evaluator(kernels, cases[k].bsdf, cases[k].sampling);
    Random random(1000 * id + k);
    for (std::size_t done = 0; done < each; done += batch) {
      body(cases[k], evaluator, random, std::min(batch, each - done));
      bench.tell(static_cast<double>(k) / static_cast<double>(cases.size()));
    }
  }
}

std::vector<DirectionPair> pairs_of(const BsdfCase& c, Random& random, std::size_t count) {
  std::vector<DirectionPair> pairs;
  pairs.reserve(count);
  for (std::size_t i = 0; i < count; ++i) pairs.push_back(direction_pair(c, random));
  return pairs;
}

bool is_sound(const vec3& v) {
  return glm::all(glm::greaterThanEqual(v, vec3(0))) && std::isfinite(v.x + v.y + v.z);
}

Check base_check(std::size_t id, const char* what, const char* range, const char* unit,
                 double limit) {
  return make_check("BSDFs", fmt::format("{}: {}", bsdf_type_names.at(id), what), range, unit,
                    limit);
}

/// How far a value may be off, over the value: beyond Beckmann's exponent of ten it grows with it.
/// Where it times the cosine is below 1e-30, nobody sees it, and floats underflow.
double deviation_of(const BsdfValue& found, const ExactValue& right, const DirectionPair& p) {
  // Beside e^-87 float ends, and kernels say 0; of that nobody sees anything either.
  if (right.exponent > 86.9) return right.exponent > 87.1 ? -1 : 0;
  const double slope = std::max(1.0, right.exponent / 10);
  const double least = 1e-30 / std::abs(p.wi.z);
  double worst = 0;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto error = static_cast<double>(abs(Exact(found.f[k]) - right.f[i]));
    const double size = std::max(static_cast<double>(right.size[i]), least);
    const double relative = std::isfinite(found.f[k]) ? error / (size * slope)
                                                      : std::numeric_limits<double>::infinity();
    worst = std::max(worst, relative);
  }
  return worst;
}

Check value_check(std::size_t id) {
  Check check = base_check(id, "value",
                           "pairs of directions, parameters at extremes, against 160 bits; in "
                           "units of max(1, tan^2/alpha^2/10), beside what two ulp of the "
                           "microfacet's cosine change, and in refraction of the directions, where "
                           "a neighbouring one changes less than 1 %",
                           "relative error", 1e-5);
  check.measure = [id](Bench& bench) {
    Finding finding;
    for_each_batch(
        bench, id,
        [&](const BsdfCase& c, KernelBsdfEvaluator& kernels, Random& random, std::size_t count) {
          const std::vector<DirectionPair> pairs = pairs_of(c, random, count);
          const std::vector<BsdfValue> found = kernels.evaluate(pairs);
          const std::vector<double> deviations = deviations_of(count, [&](std::size_t i) {
            const std::optional<ExactValue> right = exact_value(c, pairs[i]);
            if (!right) return -1.0;
            const double deviation = deviation_of(found[i], *right, pairs[i]);
            // The half vector of refraction is made by four roundings of half an ulp.
            if (!right->refracts || !(deviation > 1e-5)) return deviation;
            const double change = change_by_rounding(c, pairs[i], RelativeTo::size);
            return change < 0.01 ? deviation / (1 + 2e5 * change) : -1;
          });
          for (std::size_t i = 0; i < count; ++i)
            finding.add(deviations[i], [&] { return text(c, pairs[i]); });
        });
    return finding;
  };
  return check;
}

/// A sample with the directions of view and of the sample.
struct ViewedDraw {
  BsdfDraw draw;
  DirectionPair pair;
};

/// Calls body(case, evaluator, draws) for batches of samples seen from many directions.
template <typename Body>
void for_each_sample(Bench& bench, std::size_t id, const Body& body) {
  for_each_batch(
      bench, id,
      [&](const BsdfCase& c, KernelBsdfEvaluator& kernels, Random& random, std::size_t count) {
        std::vector<statistics::BsdfQuery> queries;
        queries.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
          const vec3 wo = view_direction(c, random);
          queries.push_back({wo, sample_numbers(random)});
        }
        const std::vector<BsdfDraw> draws = kernels.sample(queries);
        std::vector<ViewedDraw> viewed;
        viewed.reserve(count);
        for (std::size_t i = 0; i < count; ++i)
          viewed.push_back({draws[i], {queries[i].wo, draws[i].wi}});
        body(c, kernels, viewed);
      });
}

/// Of values, densities and weights.
Check soundness_check(std::size_t id) {
  Check check = base_check(id, "nothing NaN, infinite or negative",
                           "values, densities, samples and weights at extremes", "bad results", 0);
  check.measure = [id](Bench& bench) {
    Finding finding;
    const auto note = [&](bool sound, const BsdfCase& c, const DirectionPair& p) {
      finding.count(1, sound ? 0 : 1, [&] { return text(c, p); });
    };
    for_each_batch(
        bench, id,
        [&](const BsdfCase& c, KernelBsdfEvaluator& kernels, Random& random, std::size_t count) {
          const std::vector<DirectionPair> pairs = pairs_of(c, random, count);
          const std::vector<BsdfValue> values = kernels.evaluate(pairs);
          for (std::size_t i = 0; i < count; ++i)
            note(is_sound(values[i].f) && is_sound(vec3(values[i].pdf)), c, pairs[i]);
        });
    for_each_sample(bench, id,
                    [&](const BsdfCase& c, KernelBsdfEvaluator& /*kernels*/,
                        const std::vector<ViewedDraw>& draws) {
                      for (const auto& [d, pair] : draws) {
                        const bool counts = d.weight != vec3(0);
                        const bool sound =
                            is_sound(d.weight) && (!counts || std::isfinite(d.pdf)) &&
                            (!counts || std::abs(glm::length(dvec3(d.wi)) - 1) < 1e-6);
                        note(sound, c, pair);
                      }
                    });
    return finding;
  };
  return check;
}

/// How much rounding the sampled direction to float may change a density: its half vector moves by
/// that, and D with it; beside the critical angle what is let through, too.
double allowed_by_rounding(const BsdfCase& c, const DirectionPair& p) {
  const bool reflects = (p.wo.z > 0) == (p.wi.z > 0);
  const double eta_o = reflects ? 1 : (p.wo.z > 0 ? c.ext_ior : c.int_ior);
  const double eta_i = reflects ? 1 : (p.wi.z > 0 ? c.ext_ior : c.int_ior);
  const dvec3 h = eta_o * dvec3(p.wo) + eta_i * dvec3(p.wi);
  const double z = std::abs(h.z);
  if (!(z > 0)) return std::numeric_limits<double>::infinity();
  const double tangent = std::sqrt(h.x * h.x + h.y * h.y) / z;
  const double change =
      2 * (1 + tangent / c.alpha) * (0x1p-23 * std::max(eta_o, eta_i) / z) / c.alpha;
  return 1 + 1e5 * change;
}

/// The same by the model itself, where it has a closed form; the sample's cosine at its microfacet
/// is rounded, too, and so is that of the value. Infinite where the model has no value.
double allowed_by_model(const BsdfCase& c, const DirectionPair& p) {
  const std::optional<ExactValue> right = exact_value(c, p);
  if (right && right->f == ExactValue().f) return std::numeric_limits<double>::infinity();
  // The sample's direction is rounded, and so is the half vector that is made of it, four times.
  return 1 + 1e5 * (3 * change_by_rounding(c, p, RelativeTo::value) + change_by_cosine(c, p));
}

/// deviation(draw, value of its direction): relative.
template <typename Deviation>
Check draw_check(std::size_t id, const char* what, const Deviation& deviation) {
  Check check =
      base_check(id, what,
                 "samples at extremes; beside what rounding their direction changes, where "
                 "that is less than 1 %",
                 "relative error", 1e-5);
  check.measure = [id, deviation](Bench& bench) {
    Finding finding;
    for_each_sample(
        bench, id,
        [&](const BsdfCase& c, KernelBsdfEvaluator& kernels, const std::vector<ViewedDraw>& draws) {
          std::vector<DirectionPair> pairs;
          pairs.reserve(draws.size());
          for (const ViewedDraw& d : draws) pairs.push_back(d.pair);
          const std::vector<BsdfValue> values = kernels.evaluate(pairs);
          const std::vector<double> deviations = deviations_of(draws.size(), [&](std::size_t i) {
            const BsdfDraw& d = draws[i].draw;
            if (d.weight == vec3(0) || d.pdf < 0) return -1.0;
            const double off = deviation(d, values[i]);
            double allowed = off > 1e-5 ? allowed_by_rounding(c, pairs[i]) : 1;
            if (off > 1e-5 * allowed) allowed *= allowed_by_model(c, pairs[i]);
            return allowed < 3e3 ? off / allowed : -1;
          });
          for (std::size_t i = 0; i < draws.size(); ++i)
            finding.add(deviations[i], [&] { return text(c, pairs[i]); });
        });
    return finding;
  };
  return check;
}

Check density_check(std::size_t id) {
  return draw_check(id, "density of a sample, asked again",
                    [](const BsdfDraw& d, const BsdfValue& v) {
                      if (!(v.pdf > 1e-20F) && !(d.pdf > 1e-20F)) return -1.0;
                      return std::abs(static_cast<double>(d.pdf) - v.pdf) / std::max(d.pdf, v.pdf);
                    });
}

Check weight_check(std::size_t id) {
  return draw_check(
      id, "weight of a sample, by value and density", [](const BsdfDraw& d, const BsdfValue& v) {
        if (!(v.pdf > 1e-20F)) return -1.0;
        double worst = 0;
        for (int k = 0; k < 3; ++k) {
          const double by_value = static_cast<double>(v.f[k]) * std::abs(d.wi.z) / v.pdf;
          const double size = std::max({static_cast<double>(d.weight[k]), by_value, 1e-6});
          worst = std::max(worst, std::abs(d.weight[k] - by_value) / size);
        }
        return worst;
      });
}

}  // namespace

std::vector<Check> bsdf_checks() {
  std::vector<Check> checks;
  for (std::size_t id = 0; id < bsdf_type_names.size(); ++id) {
    checks.push_back(value_check(id));
    checks.push_back(soundness_check(id));
    // Delta lobes have no density.
    const std::vector<BsdfCase> cases = bsdf_cases(id);
    if (std::all_of(cases.begin(), cases.end(), [](const BsdfCase& c) { return c.is_delta; }))
      continue;
    checks.push_back(density_check(id));
    checks.push_back(weight_check(id));
  }
  return checks;
}

}  // namespace facet::extremes
