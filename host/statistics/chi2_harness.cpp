#include "statistics/chi2_harness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "statistics/direction_bins.h"
#include "statistics/pearson.h"

namespace facet::statistics {

namespace {

/// Expected counts below this are pooled.
constexpr double least_expected = 5;
/// Mass that quadrature may miss between its points, and that rounded densities may hide.
constexpr double unseen = 1e-4;
constexpr std::size_t most_deltas = 8;

bool is_unit(const vec3& w) { return std::abs(glm::dot(w, w) - 1.0F) < 1e-5F; }

bool is_weight(const vec3& w) {
  return std::isfinite(w.x) && std::isfinite(w.y) && std::isfinite(w.z) && w.x >= 0 && w.y >= 0 &&
         w.z >= 0;
}

bool is_rejected(const BsdfDraw& d) { return d.weight == vec3(0); }

/// A sample that nothing may ever give. What is rejected needs no direction.
bool is_bad(const BsdfDraw& d) {
  if (!is_weight(d.weight)) return true;
  return !is_rejected(d) && (!is_unit(d.wi) || !std::isfinite(d.pdf) || d.pdf == 0);
}

/// What became of the samples.
struct Tally {
  std::vector<std::uint64_t> bins;
  std::uint64_t rejected = 0;
  std::uint64_t bad = 0;
  std::vector<DeltaDirection> deltas;
  dvec3 sum{0};
  dvec3 squares{0};

  void count_delta(const vec3& wi, std::uint64_t count) {
    for (DeltaDirection& d : deltas) {
      if (d.wi != wi) continue;
      d.count += count;
      return;
    }
    // One more than allowed is enough to tell.
    if (deltas.size() <= most_deltas) deltas.push_back({wi, count});
  }

  void add(const BsdfDraw& draw, const DirectionBins& where, float side, float transmission_scale) {
    if (is_bad(draw)) {
      ++bad;
    } else if (is_rejected(draw)) {
      ++rejected;
    } else {
      const dvec3 w = dvec3(draw.weight) *
                      (draw.wi.z * side < 0 ? static_cast<double>(transmission_scale) : 1.0);
      sum += w;
      squares += w * w;
      if (draw.pdf < 0) {
        count_delta(draw.wi, 1);
      } else {
        ++bins[where.bin_of(draw.wi)];
      }
    }
  }

  void add(const Tally& other) {
    for (std::size_t i = 0; i < bins.size(); ++i) bins[i] += other.bins[i];
    rejected += other.rejected;
    bad += other.bad;
    for (const DeltaDirection& d : other.deltas) count_delta(d.wi, d.count);
    sum += other.sum;
    squares += other.squares;
  }
};

Tally count_samples(std::span<const BsdfDraw> draws, const DirectionBins& bins, float side,
                    float scale) {
  Tally total;
  total.bins.resize(bins.bin_count());
  // Sums of doubles depend on their order; threads' tallies are therefore added in order of the
  // samples.
  constexpr std::size_t grain = 1U << 16U;
  std::vector<Tally> tallies((draws.size() + grain - 1) / grain);
  parallel_for(draws.size(), grain, [&](std::size_t begin, std::size_t end) {
    Tally& tally = tallies[begin / grain];
    tally.bins.resize(bins.bin_count());
    for (std::size_t i = begin; i < end; ++i) tally.add(draws[i], bins, side, scale);
  });
  for (const Tally& t : tallies) total.add(t);
  return total;
}

/// The samples that have a density.
std::vector<BsdfDraw> accepted(std::vector<BsdfDraw> draws) {
  std::erase_if(draws, [](const BsdfDraw& d) { return is_bad(d) || is_rejected(d) || d.pdf < 0; });
  return draws;
}

void set_weight(Chi2Result& result, const Tally& tally, double samples) {
  result.weight.mean = tally.sum / samples;
  const dvec3 variance =
      glm::max(tally.squares / samples - result.weight.mean * result.weight.mean, dvec3(0));
  result.weight.error = glm::sqrt(variance / (samples - 1));
}

std::string find_fault(const Chi2Result& r, const Chi2Options& options, double significance) {
  if (r.bad_samples > 0) return fmt::format("{} bad samples", r.bad_samples);
  if (r.deltas.size() > most_deltas) return "too many directions of delta lobes";
  const bool has_density = r.deltas.empty() || r.pdf_integral > 0;
  if (has_density && r.populated_bins < options.least_bins)
    return fmt::format("only {} bins have samples", r.populated_bins);
  if (!(r.p_value >= significance))
    return fmt::format("p = {:.3g} is below {:.3g}", r.p_value, significance);
  return "";
}

}  // namespace

Chi2Result test_sampling(BsdfEvaluator& evaluator, const vec3& wo, const Chi2Options& options,
                         double significance) {
  const std::vector<BsdfDraw> pilots =
      accepted(evaluator.sample(wo, options.pilots, options.seed + 1));
  const DirectionBins bins(wo, pilots, options.bins);
  const DensityIntegral integral =
      integrate_density(evaluator, wo, bins.coordinates(), bins.cells(), bins.bin_count());
  const Tally tally = count_samples(evaluator.sample(wo, options.samples, options.seed), bins,
                                    wo.z < 0 ? -1.0F : 1.0F, options.transmission_scale);
  const double samples = options.samples;
  Chi2Result result;
  result.pdf_integral = integral.total;
  result.integral_error = integral.error + unseen * integral.total;
  result.evaluations = integral.evaluations;
  result.rejected_share = static_cast<double>(tally.rejected) / samples;
  result.bad_samples = tally.bad;
  result.deltas = tally.deltas;
  set_weight(result, tally, samples);
  std::vector<Count> counts;
  for (std::size_t i = 0; i < tally.bins.size(); ++i)
    counts.push_back({integral.bins[i] * samples, static_cast<double>(tally.bins[i])});
  std::uint64_t rest = tally.rejected;
  for (const DeltaDirection& d : tally.deltas) rest += d.count;
  Pearson pearson(std::move(counts), least_expected);
  pearson.add_rest({std::max(0.0, 1 - integral.total) * samples, static_cast<double>(rest)},
                   result.integral_error * samples);
  result.statistic = pearson.statistic();
  result.degrees = pearson.degrees();
  result.populated_bins = pearson.populated();
  result.p_value = pearson.p_value();
  result.fault = find_fault(result, options, significance);
  return result;
}

}  // namespace facet::statistics
