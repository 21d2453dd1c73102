#include "render/pack/emitter_table.h"

#include <algorithm>
#include <numbers>

#include "render/pack/choice.h"
#include "render/pack/emitter_pieces.h"
#include "render/pack/parameter_records.h"
#include "scene/emitter/light_tree.h"

namespace facet {

namespace {

constexpr double pi = std::numbers::pi;

/// Turns powers into the weights of the settings' way to choose emitters
/// (docs/reference/sampling.md, "Emitter sample").
void select_emitters(std::vector<double>& weights, EmitterSelection selection) {
  double total = 0;
  double positive = 0;
  for (const double power : weights) {
    total += power;
    if (power > 0) ++positive;
  }
  const bool by_power = selection == EmitterSelection::power;
  for (double& weight : weights) {
    if (weight > 0) weight = (by_power ? weight / total : 0) + 1 / positive;
  }
}

class Maker {
 public:
  Maker(const Scene& scene, const RenderSettings& settings, double radius,
        const PlacesOfMesh& places_of)
      : scene_(scene),
        selection_(settings.integrator.emitter_selection),
        compensated_(settings.integrator.compensates_environment()),
        wants_tree_(settings.integrator.wants_light_tree()),
        radius_(radius),
        places_of_(places_of) {}

  EmitterTable make() {
    std::vector<double> powers;
    for (std::uint32_t e = 0; e < scene_.emitters.size(); ++e) powers.push_back(add_emitter(e));
    choose_emitters(powers);
    if (wants_tree_ && sources_.size() > 1) plant_tree();
    return std::move(table_);
  }

 private:
  /// A piece of a mesh, or a point light, that is a source of the tree.
  struct Origin {
    std::uint32_t emitter;
    std::size_t triangle;  ///< of emitter `emitter`, in order of reading; of two, the second
  };

  /// Returns the emitter's power, W of white light.
  double add_emitter(std::uint32_t e) {
    shared::EmitterRecord record = pack_emitter(scene_.emitters[e]);
    double power = 0;
    if (const auto* area = std::get_if<AreaEmitter>(&scene_.emitters[e])) {
      power = add_area(*area, e, record);
    } else if (const auto* point = std::get_if<PointLight>(&scene_.emitters[e])) {
      power = add_point(*point, e);
    } else {
      table_.environment =
          make_environment_table(std::get<EnvironmentEmitter>(scene_.emitters[e]), compensated_);
      sky_luminance_ = table_.environment.mean_luminance;
      power = 4 * pi * pi * radius_ * radius_ * sky_luminance_;
    }
    table_.emitters.push_back(record);
    return power;
  }

  double add_point(const PointLight& light, std::uint32_t e) {
    LightSource source;
    source.box.add(light.position);
    source.energy = static_cast<double>(luminance(light.intensity));
    add_source(source, {e, 0});
    return 4 * pi * source.energy;
  }

  /// Triangles in order of reading, with the counts of the choice by area.
  double add_area(const AreaEmitter& light, std::uint32_t e, shared::EmitterRecord& record) {
    const std::vector<EmitterPiece> pieces = emitter_pieces(scene_.meshes[light.mesh]);
    const std::vector<std::uint32_t> places = places_of_(light.mesh);
    record.first_triangle = static_cast<std::uint32_t>(table_.triangles.size());
    record.triangle_count = static_cast<std::uint32_t>(pieces.size());
    const auto radiance = static_cast<double>(luminance(scene_.mean_radiance(light)));
    double total = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      total += pieces[i].area;
      shared::EmitterTriangle t{};
      t.triangle = places[i];
      t.corner = pieces[i].corner;
      table_.triangles.push_back(t);
      areas_.push_back(pieces[i]);
      if (pieces[i].weight > 0) add_piece(light.mesh, pieces[i], radiance, {e, i});
    }
    count_words(record.first_triangle, pieces, table_.triangles);
    // Kernels without branches look at the first triangle even of an emitter that has none and is
    // never chosen.
    if (pieces.empty()) record.first_triangle = 0;
    return pi * total * radiance;
  }

  void add_piece(std::uint32_t mesh, const EmitterPiece& piece, double radiance,
                 const Origin& origin) {
    if (!wants_tree_) return;
    const std::size_t count = piece.corner == shared::NO_CORNER ? 1 : 2;
    LightSource source = piece_source(scene_.meshes[mesh], origin.triangle + 1 - count, count);
    source.energy = radiance * piece.weight;
    source.mesh = mesh;
    add_source(source, origin);
  }

  void add_source(const LightSource& source, const Origin& origin) {
    if (!(source.energy > 0)) return;
    sources_.push_back(source);
    origins_.push_back(origin);
  }

  /// Counts and densities of the triangles from `first` on, chosen by area among themselves.
  static void count_words(std::size_t first, std::span<const EmitterPiece> pieces,
                          std::vector<shared::EmitterTriangle>& triangles) {
    std::vector<double> weights;
    for (const EmitterPiece& piece : pieces) weights.push_back(piece.weight);
    const std::vector<std::uint32_t> counts = cumulative_counts(weights);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const EmitterPiece& piece = pieces[i];
      const bool alone = piece.corner == shared::NO_CORNER;
      const std::size_t chosen = piece.weight > 0 ? i : std::min(i + 1, counts.size() - 1);
      const double probability = choice_probability(counts, chosen) / (alone ? 1 : 2);
      const double density = piece.area > 0 ? probability / piece.area : 0;
      triangles[first + i].cumulative = counts[i];
      triangles[first + i].density = static_cast<float>(std::min(density, 1e38));
    }
  }

  void choose_emitters(std::vector<double>& weights) {
    select_emitters(weights, selection_);
    const std::vector<std::uint32_t> counts = cumulative_counts(weights);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      table_.emitters[i].cumulative = counts[i];
      table_.emitters[i].probability = static_cast<float>(choice_probability(counts, i));
    }
  }

  /// Orders the triangles by the leaves of a light tree.
  void plant_tree() {
    const LightTree tree = build_light_tree(sources_);
    // Those that do not shine follow, so that each has a place.
    std::vector<shared::EmitterTriangle> ordered;
    table_.places.assign(table_.triangles.size(), {none, 0, 0, 0});
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
      const LightTree::Node& node = tree.nodes[n];
      shared::LightNode packed{glm::vec4(node.center, node.radius),
                               glm::vec4(node.axis, node.cosine),
                               node.energy,
                               node.parent,
                               node.first,
                               node.count};
      if (node.is_leaf()) fill_leaf(tree, n, packed, ordered);
      table_.light_nodes.push_back(packed);
    }
    for (std::size_t i = 0; i < table_.places.size(); ++i) {
      if (table_.places[i].triangle != none) continue;
      table_.places[i].triangle = static_cast<std::uint32_t>(ordered.size());
      ordered.push_back(table_.triangles[i]);
    }
    table_.triangles = std::move(ordered);
    table_.environment_irradiance = static_cast<float>(pi * sky_luminance_ / tree.energy);
  }

  void fill_leaf(const LightTree& tree, std::uint32_t leaf, shared::LightNode& packed,
                 std::vector<shared::EmitterTriangle>& ordered) {
    std::vector<EmitterPiece> pieces;
    const std::size_t first = ordered.size();
    for (std::uint32_t s = packed.first; s < packed.first + packed.count; ++s) {
      const Origin& origin = origins_[tree.order[s]];
      if (std::holds_alternative<PointLight>(scene_.emitters[origin.emitter])) {
        packed.first = origin.emitter;
        packed.count = shared::LIGHT_POINT;
        return;
      }
      const std::size_t last = table_.emitters[origin.emitter].first_triangle + origin.triangle;
      const bool alone = areas_[last].corner == shared::NO_CORNER;
      for (std::size_t i = last - (alone ? 0 : 1); i <= last; ++i) {
        table_.places[i] = {static_cast<std::uint32_t>(ordered.size()), leaf, 0, 0};
        ordered.push_back(table_.triangles[i]);
        pieces.push_back(areas_[i]);
      }
    }
    count_words(first, pieces, ordered);
    packed.first = static_cast<std::uint32_t>(first);
    packed.count = static_cast<std::uint32_t>(pieces.size());
  }

  const Scene& scene_;
  EmitterSelection selection_;
  bool compensated_;
  bool wants_tree_;
  double radius_;
  const PlacesOfMesh& places_of_;
  EmitterTable table_;
  std::vector<EmitterPiece> areas_;  ///< of table_.triangles, in order of reading
  std::vector<LightSource> sources_;
  std::vector<Origin> origins_;  ///< of the sources
  double sky_luminance_ = 0;
};

}  // namespace

EmitterTable make_emitter_table(const Scene& scene, const RenderSettings& settings, double radius,
                                const PlacesOfMesh& places_of) {
  return Maker(scene, settings, radius, places_of).make();
}

}  // namespace facet
