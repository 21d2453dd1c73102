#pragma once
#include "reference/choice.h"
#include "reference/emitter/piece.h"
#include "reference/emitter/sample.h"
#include "reference/emitter/seen_triangle.h"
#include "reference/emitter/share.h"
#include "reference/surface.h"
#include "reference/texture.h"
#include "scene/emitter/light_tree.h"

namespace facet::reference {

/// A mesh that emits to the side of its shading normals.
template <typename Real>
class AreaLight {
 public:
  AreaLight(const Scene& scene, const Geometry<Real>& geometry, const AreaEmitter& emitter,
            AreaSampling sampling)
      : scene_(scene),
        geometry_(geometry),
        sampling_(sampling),
        mesh_(emitter.mesh),
        radiance_(emitter.emitted().value),
        texture_(emitter.radiance.texture) {
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
    densities_in_piece_.resize(count);
    piece_of_.resize(count);
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const EmittingPiece& piece = pieces_[p];
      const double part = 1 / static_cast<double>(piece.triangle_count());
      for (std::size_t i = piece.first; i < piece.first + piece.triangle_count(); ++i) {
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

  /// Density per solid angle of finding the point of s in direction d and at a distance from a
  /// point, sr^-1; or that once its piece is chosen.
  template <typename Probe>
  [[nodiscard]] Real pdf(const Surface<Real>& s, const Vec3<Real>& from, const Vec3<Real>& d,
                         Real distance, Probe& probe) const {
    const double chosen = by_area_.probability(piece_of_[s.index]);
    return static_cast<Real>(chosen) * pdf_in_piece(s, from, d, distance, probe);
  }
  template <typename Probe>
  [[nodiscard]] Real pdf_in_piece(const Surface<Real>& s, const Vec3<Real>& from,
                                  const Vec3<Real>& d, Real distance, Probe& probe) const {
    const std::size_t piece = piece_of_[s.index];
    if (const auto view = view_of(piece, from, probe))
      return view->density(s.index - pieces_[piece].first);
    return per_solid_angle(s, d, distance);
  }

  template <typename Probe>
  [[nodiscard]] EmitterSample<Real> sample(const Surface<Real>& from, const EmitterNumbers& numbers,
                                           Probe& probe) const {
    const Choice::Outcome chosen = by_area_.choose(numbers.u, numbers.second_fill);
    EmitterSample<Real> s =
        sample_piece(chosen.entry, chosen.remainder, numbers.v, numbers.second_fill, from, probe);
    s.pdf *= static_cast<Real>(by_area_.probability(chosen.entry));
    return s;
  }

  /// A point of one piece; u, v: words, fill: that of u.
  template <typename Probe>
  [[nodiscard]] EmitterSample<Real> sample_piece(std::size_t piece, std::uint32_t u,
                                                 std::uint32_t v, std::uint32_t fill,
                                                 const Surface<Real>& from, Probe& probe) const {
    const auto view = view_of(piece, from.position, probe);
    const PiecePoint<Real> at =
        view ? view->point(u, v, fill)
             : point_of(pieces_[piece], number_of<Real>(u), number_of<Real>(v));
    Surface<Real> point =
        surface_at(scene_, geometry_.triangles[triangles_[at.triangle]], at.b1, at.b2, probe);
    const Vec3<Real> way = point.position - from.position;
    EmitterSample<Real> sample;
    sample.direction = probe.nudged(unit(way));
    sample.pdf = view ? view->density(at.triangle - pieces_[piece].first)
                      : per_solid_angle(point, sample.direction, glm::dot(way, sample.direction));
    sample.radiance = emission(point, sample.direction, probe);
    // The offset covers the error of a test that comes from the shaded surface.
    point.magnitude = std::max(point.magnitude, from.magnitude);
    sample.end = point.origin_towards(-sample.direction, 1, probe);
    return sample;
  }

 private:
  /// A piece as it is seen from a point, by whose solid angle its points are sampled.
  struct View {
    const EmittingPiece& piece;
    std::vector<SeenTriangle<Real>> triangles;
    TwoWayChoice first_of_two;

    /// The point (u, v); fill: u's word before.
    [[nodiscard]] PiecePoint<Real> point(std::uint32_t u, std::uint32_t v,
                                         std::uint32_t fill) const {
      std::size_t chosen = 0;
      if (piece.is_pair) {
        const bool is_first = first_of_two.is_first(u);
        u = first_of_two.remainder(is_first, u, next_fill(fill));
        chosen = is_first ? 0 : 1;
      }
      const Vec3<Real> weights = triangles[chosen].point(number_of<Real>(u), number_of<Real>(v));
      return {piece.first + chosen, weights.y, weights.z};
    }

    /// Of the points of triangle 0 or 1, sr^-1.
    [[nodiscard]] Real density(std::size_t triangle) const {
      const double first = first_of_two.probability();
      const double share = !piece.is_pair ? 1 : triangle == 0 ? first : 1 - first;
      return static_cast<Real>(share) / triangles[triangle].solid_angle();
    }
  };

  /// Nothing where the piece's points are sampled by area.
  template <typename Probe>
  [[nodiscard]] std::optional<View> view_of(std::size_t piece, const Vec3<Real>& from,
                                            Probe& probe) const {
    if (sampling_ != AreaSampling::solid_angle) return std::nullopt;
    View view{pieces_[piece], {}, TwoWayChoice(0)};
    const Vec3<Real> eye = probe.nudged(from);
    Real all = 0;
    for (std::size_t i = 0; i < view.piece.triangle_count(); ++i) {
      const Triangle<Real>& t = geometry_.triangles[triangles_[view.piece.first + i]];
      view.triangles.emplace_back(t.vertices[0], t.vertices[1], t.vertices[2], t.normal, eye);
      all += view.triangles.back().solid_angle();
    }
    constexpr auto kind = DecisionKind::solid_angle;
    if (!probe.reaches(kind, all, 0.001, 2 * piece) ||
        !probe.below(kind, all, Real(6), 2 * piece + 1))
      return std::nullopt;
    if (view.piece.is_pair)
      view.first_of_two = TwoWayChoice(
          share_of_first(view.triangles[0].solid_angle(), view.triangles[1].solid_angle(),
                         DecisionKind::solid_angle_share, piece, probe));
    return view;
  }

  /// Density by area within its piece.
  [[nodiscard]] Real per_solid_angle(const Surface<Real>& s, const Vec3<Real>& d,
                                     Real distance) const {
    const auto density = static_cast<Real>(densities_in_piece_[s.index]);
    const Real cosine = std::abs(glm::dot(s.ng, d));
    return cosine > 0 ? distance * density * (distance / cosine) : Real(0);
  }

  const Scene& scene_;
  const Geometry<Real>& geometry_;
  AreaSampling sampling_;
  std::uint32_t mesh_;
  Vec3<Real> radiance_;
  std::uint32_t texture_;
  std::vector<std::uint32_t> triangles_;  ///< places of the mesh's triangles
  std::vector<EmittingPiece> pieces_;
  Choice by_area_;                          ///< of a piece
  std::vector<double> densities_in_piece_;  ///< of points of each triangle, m^-2
  std::vector<std::size_t> piece_of_;       ///< of each triangle
  std::vector<double> areas_;               ///< of the pieces, m^2
  double luminance_ = 0;
  double power_ = 0;
};

}  // namespace facet::reference
