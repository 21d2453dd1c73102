#include "statistics/density_integral.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace facet::statistics {

namespace {

constexpr int most_rounds = 26;

struct Estimated {
  Cell cell;
  double mass = 0;
  double peak = 0;    ///< largest density among its Gauss points
  double corner = 0;  ///< and close to its corners
};

/// Whether some density stands out, and would matter if all of the cell had it: that of a sample,
/// whose peak lies between the points, or that of a corner, where a density that ends with a step
/// (GGX at grazing normals) reaches into the cell but to no Gauss point.
bool has_missed_peak(const Estimated& e, double tolerance) {
  const auto stands_out = [&](double pdf) {
    return pdf > 4 * e.peak && pdf * e.cell.area.area() > tolerance;
  };
  return stands_out(e.corner) ||
         std::ranges::any_of(e.cell.pilots, [&](const Pilot& p) { return stands_out(p.pdf); });
}

std::array<Cell, 4> quarters(const Cell& cell) {
  const Rectangle& a = cell.area;
  const std::array<double, 2> middle{0.5 * (a.lower[0] + a.upper[0]),
                                     0.5 * (a.lower[1] + a.upper[1])};
  std::array<Cell, 4> result;
  for (std::size_t q = 0; q < 4; ++q) {
    result[q].area = a;
    result[q].bin = cell.bin;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if ((q >> axis & 1U) == 0) {
        result[q].area.upper[axis] = middle[axis];
      } else {
        result[q].area.lower[axis] = middle[axis];
      }
    }
  }
  for (const Pilot& p : cell.pilots)
    result[(p.at.v < middle[0] ? 0U : 1U) + (p.at.phi < middle[1] ? 0U : 2U)].pilots.push_back(p);
  return result;
}

class Quadrature {
 public:
  Quadrature(BsdfEvaluator& evaluator, const vec3& wo, const SphereCoordinates& coordinates)
      : evaluator_(evaluator), wo_(wo), coordinates_(coordinates) {}

  /// Mass of every cell by three times three Gauss points, and a look at its corners.
  std::vector<Estimated> estimate(std::vector<Cell> cells) {
    std::vector<DirectionPair> pairs;
    pairs.reserve(cells.size() * point_count);
    for (const Cell& cell : cells) add_points(cell.area, pairs);
    const std::vector<BsdfValue> values = evaluator_.evaluate(pairs);
    evaluations += values.size();
    std::vector<Estimated> result(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Rectangle& a = cells[i].area;
      double sum = 0;
      double peak = 0;
      for (std::size_t k = 0; k < 9; ++k) {
        const double pdf = values[point_count * i + k].pdf;
        sum += weights[k / 3] * weights[k % 3] * pdf;
        peak = std::max(peak, pdf);
      }
      double corner = 0;
      for (std::size_t k = 9; k < point_count; ++k)
        corner = std::max(corner, static_cast<double>(values[point_count * i + k].pdf));
      result[i] = {std::move(cells[i]), sum * a.area(), peak, corner};
    }
    return result;
  }

  static constexpr std::size_t point_count = 9 + 4;  ///< of a cell
  std::uint64_t evaluations = 0;

 private:
  static constexpr std::array<double, 3> weights{5.0 / 18, 8.0 / 18, 5.0 / 18};

  void add_points(const Rectangle& a, std::vector<DirectionPair>& pairs) const {
    static const std::array<double, 3> gauss{0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
    // Not on the border, which may be the horizon.
    static constexpr std::array<double, 2> corners{1e-3, 1 - 1e-3};
    add_grid(a, gauss, pairs);
    add_grid(a, corners, pairs);
  }

  void add_grid(const Rectangle& a, std::span<const double> shares,
                std::vector<DirectionPair>& pairs) const {
    for (const double x : shares) {
      for (const double y : shares) {
        const Coordinates c{a.side, a.lower[0] + x * (a.upper[0] - a.lower[0]),
                            a.lower[1] + y * (a.upper[1] - a.lower[1])};
        pairs.push_back({wo_, coordinates_.direction(c)});
      }
    }
  }

  BsdfEvaluator& evaluator_;
  vec3 wo_;
  const SphereCoordinates& coordinates_;
};

}  // namespace

DensityIntegral integrate_density(BsdfEvaluator& evaluator, const vec3& wo,
                                  const SphereCoordinates& coordinates, std::vector<Cell> cells,
                                  std::size_t bin_count, const QuadratureOptions& options) {
  DensityIntegral result;
  result.bins.resize(bin_count);
  Quadrature quadrature(evaluator, wo, coordinates);
  std::vector<Estimated> open = quadrature.estimate(std::move(cells));
  for (int round = 1; !open.empty(); ++round) {
    // This round, and one after it in which every cell is still open.
    const std::uint64_t needed = std::uint64_t{5} * 4 * Quadrature::point_count * open.size();
    const bool last =
        round == most_rounds || quadrature.evaluations + needed > options.most_evaluations;
    std::vector<Cell> fine;
    fine.reserve(open.size() * 4);
    for (const Estimated& e : open) std::ranges::move(quarters(e.cell), std::back_inserter(fine));
    std::vector<Estimated> finer = quadrature.estimate(std::move(fine));
    std::vector<Estimated> next;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const std::span<Estimated> parts = std::span(finer).subspan(4 * i, 4);
      const double mass = parts[0].mass + parts[1].mass + parts[2].mass + parts[3].mass;
      const double difference = std::abs(mass - open[i].mass);
      const bool missed = std::ranges::any_of(
          parts, [&](const Estimated& e) { return has_missed_peak(e, options.tolerance); });
      if (!last && (difference > options.tolerance || missed)) {
        std::ranges::move(parts, std::back_inserter(next));
        continue;
      }
      result.bins[open[i].cell.bin] += mass;
      result.total += mass;
      // Where the density is smooth, quarters are better by far more than that.
      result.error += difference / 16;
    }
    open = std::move(next);
  }
  result.evaluations = quadrature.evaluations;
  return result;
}

}  // namespace facet::statistics
