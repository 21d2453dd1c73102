#pragma once
#include "reference/choice.h"
#include "reference/emitter/sample.h"
#include "reference/grid.h"
#include "reference/surface.h"
#include "scene/scene.h"

namespace facet::reference {

/// Light from infinity by a latitude-longitude map, bilinear; sampled by the cells between texels,
/// of equal angles (docs/reference/sampling.md, "Environment").
template <typename Real>
class Environment {
 public:
  /// compensated: what exceeds the mean is sampled alone.
  Environment(const EnvironmentEmitter& map, bool compensated);

  /// Weight of power selection for a scene of that bounding box, W of white light.
  [[nodiscard]] double power(const Box& bounds) const {
    const double radius = bounds.empty() ? 1 : glm::length(dvec3(bounds.extent())) / 2;
    return 4 * pi<double> * pi<double> * radius * radius * mean_luminance_;
  }

  /// On a surface that sees half of the sphere, all of it as bright as the mean, W m^-2.
  [[nodiscard]] double irradiance() const { return pi<double> * mean_luminance_; }

  /// Radiance from direction d and the density of sampling d.
  template <typename Probe>
  [[nodiscard]] Found<Real> find(const Vec3<Real>& d, Probe& probe) const {
    const Cell cell = cell_at(place_of(d, probe), DecisionKind::cell, probe);
    return {none, radiance(cell), density(cell.column, cell.row)};
  }

  template <typename Probe>
  [[nodiscard]] EmitterSample<Real> sample(const Surface<Real>& /*from*/,
                                           const EmitterNumbers& numbers, Probe& probe) const {
    const Choice::Outcome row = rows_.choose(numbers.v, numbers.first_fill ^ numbers.second_fill);
    const Choice::Outcome column = columns_[row.entry].choose(numbers.u, numbers.second_fill);
    const Real fy = number_of<Real>(row.remainder);
    const Real fx = number_of<Real>(column.remainder);
    const Real y = (1 - fy) * Real(heights_[row.entry]) + fy * Real(heights_[row.entry + 1]);
    Real sine = 0;
    Real cosine = 0;
    sin_cos_turns(1 - (static_cast<Real>(column.entry) + fx) / static_cast<Real>(width_), sine,
                  cosine);
    const Real radius = std::sqrt(std::max((1 - y) * (1 + y), Real(0)));
    EmitterSample<Real> s;
    s.direction = probe.nudged(Vec3<Real>(radius * cosine, y, radius * sine));
    s.radiance = radiance(cell_at(place_of(s.direction, probe), DecisionKind::texel, probe));
    s.pdf = density(column.entry, row.entry);
    s.at_infinity = true;
    return s;
  }

 private:
  /// Image coordinates in texels.
  struct Place {
    Real x;
    Real y;
  };

  template <typename Probe>
  [[nodiscard]] Place place_of(const Vec3<Real>& d, Probe& probe) const {
    const Real turns = std::atan2(d.z, d.x) / (2 * pi<Real>);
    const Real v = std::atan2(std::sqrt(d.x * d.x + d.z * d.z), d.y) / pi<Real>;
    // Both are shares of the whole, and carry rounding errors of 1.
    const Vec3<Real> shares = probe.nudged(Vec3<Real>(turns < 0 ? -turns : 1 - turns, 1 - v, 1));
    return {shares.x * static_cast<Real>(width_), shares.y * static_cast<Real>(height_)};
  }

  /// The cell of the density, between four texels, that a place lies in, and how far.
  struct Cell {
    std::size_t column;
    std::size_t row;
    Real fx;
    Real fy;
  };

  template <typename Probe>
  [[nodiscard]] Cell cell_at(const Place& at, DecisionKind kind, Probe& probe) const {
    const auto width = static_cast<Real>(width_);
    const auto height = static_cast<Real>(height_);
    const Real left = std::clamp(decided_floor(at.x, width, kind, 0, probe), Real(0), width - 1);
    const Real lower = std::clamp(decided_floor(at.y, height, kind, 1, probe), Real(0), height - 1);
    return {static_cast<std::size_t>(left), static_cast<std::size_t>(lower), at.x - left,
            at.y - lower};
  }

  /// The texel at a cell's corner, which may lie one beyond the last column or row.
  [[nodiscard]] const Vec3<Real>& texel(std::size_t column, std::size_t row) const {
    return texels_[std::min(row, height_ - 1) * width_ + column % width_];
  }

  [[nodiscard]] Vec3<Real> radiance(const Cell& c) const {
    const std::size_t x = c.column;
    const std::size_t y = c.row;
    return (texel(x, y) * (1 - c.fx) + texel(x + 1, y) * c.fx) * (1 - c.fy) +
           (texel(x, y + 1) * (1 - c.fx) + texel(x + 1, y + 1) * c.fx) * c.fy;
  }

  [[nodiscard]] Real density(std::size_t column, std::size_t row) const {
    return static_cast<Real>(densities_[row * width_ + column]);
  }

  std::size_t width_;
  std::size_t height_;
  std::vector<Vec3<Real>> texels_;
  std::vector<double> heights_;  ///< y of the rows' borders, height + 1
  Choice rows_;
  std::vector<Choice> columns_;
  std::vector<double> densities_;  ///< of the cells, sr^-1
  double mean_luminance_ = 0;      ///< over the sphere
};

extern template class Environment<float>;
extern template class Environment<double>;

}  // namespace facet::reference
