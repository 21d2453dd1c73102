#pragma once
#include "reference/choice.h"
#include "reference/emitter/piece.h"
#include "reference/emitter/sample.h"
#include "reference/surface.h"
#include "reference/texture.h"
#include "scene/emitter/light_tree.h"

namespace facet::reference {

/// A mesh that emits to the side of its shading normals, sampled by area.
template <typename Real>
class AreaLight {
 public:
  AreaLight(const Scene& scene, const Geometry<Real>& geometry, const AreaEmitter& emitter)
      : scene_(scene),
        geometry_(geometry),
        mesh_(emitter.mesh),
        radiance_(emitter.radiance),
        texture_(emitter.texture) {
    const Mesh& mesh = scene.meshes[emitter.mesh];
    const std::size_t count = mesh.position_indices.size();
    std::vector<double> areas;
    double area = 0;
    for (std::size_t i = 0; i < count; ++i) {
      triangles_.push_back(geometry.places[geometry.first_place[emitter.mesh] + i]);
      areas.push_back(triangle_area(mesh, i));
      area += areas.back();
    }
    std::vector<double> weights;
    for (std::size_t i = 0; i < count; i += pieces_.back().triangle_count()) {
      pieces_.push_back(piece_at(mesh, i));
      weights.push_back(areas[i] + (pieces_.back().is_pair ? areas[i + 1] : 0));
    }
    by_area_ = Choice(weights);
    densities_.resize(count);
    densities_in_piece_.resize(count);
    piece_of_.resize(count);
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const EmittingPiece& piece = pieces_[p];
      const double share = by_area_.probability(p) / static_cast<double>(piece.triangle_count());
      const double part = 1 / static_cast<double>(piece.triangle_count());
      for (std::size_t i = piece.first; i < piece.first + piece.triangle_count(); ++i) {
        densities_[i] = areas[i] > 0 ? share / areas[i] : 0;
        densities_in_piece_[i] = areas[i] > 0 ? part / areas[i] : 0;
        piece_of_[i] = p;
      }
    }
    areas_ = std::move(weights);
    luminance_ = static_cast<double>(luminance(scene.mean_radiance(emitter)));
    power_ = std::numbers::pi * area * luminance_;
  }

  /// Weight of power selection, W of white light.
  [[nodiscard]] double power(const Box& /*bounds*/) const { return power_; }

  /// Radiance towards -d.
  template <typename Probe>
  [[nodiscard]] Vec3<Real> emission(const Surface<Real>& s, const Vec3<Real>& d,
                                    Probe& probe) const {
    const Real cosine = glm::dot(s.ns, d);
    const bool bright = probe.negative(DecisionKind::emission, cosine);
    if (!bright) return Vec3<Real>(0);
    if (texture_ == none) return radiance_;
    return radiance_ * texture_value(scene_.textures, texture_, s.uv, probe);
  }

  /// The pieces that the mesh is sampled by, as sources of a light tree, and their areas.
  [[nodiscard]] std::size_t piece_count() const { return pieces_.size(); }
  [[nodiscard]] std::size_t piece_of(std::uint32_t triangle) const { return piece_of_[triangle]; }
  [[nodiscard]] double piece_area(std::size_t piece) const { return areas_[piece]; }
  [[nodiscard]] LightSource source(std::size_t piece) const {
    const EmittingPiece& p = pieces_[piece];
    LightSource s = piece_source(scene_.meshes[mesh_], p.first, p.triangle_count());
    s.energy = luminance_ * areas_[piece];
    s.mesh = mesh_;
    return s;
  }

  /// Density per solid angle of finding the point of s at a distance along d, sr^-1: by area, or
  /// once its piece is chosen.
  [[nodiscard]] Real pdf(const Surface<Real>& s, const Vec3<Real>& d, Real distance) const {
    return per_solid_angle(densities_[s.index], s, d, distance);
  }
  [[nodiscard]] Real pdf_in_piece(const Surface<Real>& s, const Vec3<Real>& d,
                                  Real distance) const {
    return per_solid_angle(densities_in_piece_[s.index], s, d, distance);
  }

  template <typename Probe>
  [[nodiscard]] EmitterSample<Real> sample(const Surface<Real>& from, const EmitterNumbers& numbers,
                                           Probe& probe) const {
    const Choice::Outcome chosen = by_area_.choose(numbers.u, numbers.second_fill);
    return sample_piece(chosen.entry, chosen.remainder, numbers.v, densities_, from, probe);
  }

  /// A point of one piece; u, v: words.
  template <typename Probe>
  [[nodiscard]] EmitterSample<Real> sample_piece(std::size_t piece, std::uint32_t u,
                                                 std::uint32_t v, const Surface<Real>& from,
                                                 Probe& probe) const {
    return sample_piece(piece, u, v, densities_in_piece_, from, probe);
  }

 private:
  [[nodiscard]] static Real per_solid_angle(double density, const Surface<Real>& s,
                                            const Vec3<Real>& d, Real distance) {
    const Real cosine = std::abs(glm::dot(s.ng, d));
    return cosine > 0 ? distance * static_cast<Real>(density) * (distance / cosine) : Real(0);
  }

  /// densities: of the points of each triangle, m^-2.
  template <typename Probe>
  [[nodiscard]] EmitterSample<Real> sample_piece(std::size_t piece, std::uint32_t u,
                                                 std::uint32_t v,
                                                 const std::vector<double>& densities,
                                                 const Surface<Real>& from, Probe& probe) const {
    const PiecePoint<Real> at = point_of(pieces_[piece], number_of<Real>(u), number_of<Real>(v));
    Surface<Real> point =
        surface_at(scene_, geometry_.triangles[triangles_[at.triangle]], at.b1, at.b2, probe);
    const Vec3<Real> way = point.position - from.position;
    EmitterSample<Real> sample;
    sample.direction = probe.nudged(unit(way));
    sample.pdf = per_solid_angle(densities[point.index], point, sample.direction,
                                 glm::dot(way, sample.direction));
    sample.radiance = emission(point, sample.direction, probe);
    // The offset covers the error of a test that comes from the shaded surface.
    point.magnitude = std::max(point.magnitude, from.magnitude);
    sample.end = point.origin_towards(-sample.direction, 1, probe);
    return sample;
  }

  const Scene& scene_;
  const Geometry<Real>& geometry_;
  std::uint32_t mesh_;
  Vec3<Real> radiance_;
  std::uint32_t texture_;
  std::vector<std::uint32_t> triangles_;  ///< places of the mesh's triangles
  std::vector<EmittingPiece> pieces_;
  Choice by_area_;                          ///< of a piece
  std::vector<double> densities_;           ///< of points of each triangle, m^-2
  std::vector<double> densities_in_piece_;  ///< the same once the piece is chosen
  std::vector<std::size_t> piece_of_;       ///< of each triangle
  std::vector<double> areas_;               ///< of the pieces, m^2
  double luminance_ = 0;
  double power_ = 0;
};

}  // namespace facet::reference
