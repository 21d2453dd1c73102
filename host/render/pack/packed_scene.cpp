#include "render/pack/packed_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "core/clock.h"
#include "core/parallel.h"
#include "render/pack/emitter_table.h"
#include "render/pack/filter_table.h"
#include "render/pack/parameter_records.h"
#include "render/pack/texture_table.h"
#include "scene/bsdf/albedo_table.h"

namespace facet {

namespace {

/// A triangle of the scene before it has its place in the BVH.
struct SourceTriangle {
  std::uint32_t mesh;
  std::uint32_t index;  ///< within the mesh
  std::uint32_t id;     ///< within the scene
};

class Packer {
 public:
  Packer(const Scene& scene, const RenderSettings& settings) : scene_(scene), settings_(settings) {}

  PackedScene pack() {
    gather_triangles();
    const auto start = std::chrono::steady_clock::now();
    Bvh bvh = build_bvh(corners_);
    packed_.bvh_seconds = seconds_since(start);
    packed_.items = std::move(bvh.items);
    packed_.pairs = std::move(bvh.pairs);
    packed_.bvh = std::move(bvh);
    name_triangles();
    pack_meshes();
    for (const Bsdf& bsdf : bsdfs_of(scene_, settings_)) packed_.bsdfs.push_back(pack_bsdf(bsdf));
    const TextureTable textures = make_texture_table(scene_.textures);
    packed_.textures = textures.records;
    packed_.texels = textures.texels;
    pack_albedos();
    pack_emitters();
    choose_square_scale();
    pack_filter();
    pack_frame();
    return std::move(packed_);
  }

 private:
  void gather_triangles() {
    std::uint32_t id = 0;
    for (std::uint32_t m = 0; m < scene_.meshes.size(); ++m) {
      const Mesh& mesh = scene_.meshes[m];
      first_source_.push_back(sources_.size());
      first_id_.push_back(id);
      for (std::uint32_t i = 0; i < mesh.position_indices.size(); ++i, ++id) {
        // A triangle without area cannot be hit, and would only make normals that do not exist.
        if (triangle_area(mesh, i) == 0) continue;
        sources_.push_back({m, i, id});
        corners_.push_back(triangle_corners(mesh, i));
      }
    }
    first_source_.push_back(sources_.size());
  }

  [[nodiscard]] bool has_textures() const { return !scene_.textures.empty(); }

  /// Appends a mesh's indices of one attribute, moved to the scene's list of it; x = none for
  /// triangles without.
  static void append_indices(std::vector<glm::uvec4>& to, const std::vector<uvec3>& indices,
                             std::size_t triangles, std::size_t first) {
    for (std::size_t i = 0; i < triangles; ++i) {
      const bool has = !indices.empty() && indices[i].x != none;
      to.push_back(has ? glm::uvec4(indices[i] + static_cast<std::uint32_t>(first), 0)
                       : glm::uvec4(none));
    }
  }

  /// Normals and texture coordinates of the meshes that have either.
  void pack_meshes() {
    std::size_t first_triangle = 0;
    std::size_t rows = 0;
    for (const Mesh& mesh : scene_.meshes) {
      const std::size_t count = mesh.position_indices.size();
      const bool textured = has_textures() && !mesh.texcoord_indices.empty();
      std::uint32_t attributes = none;
      if (textured || !mesh.normal_indices.empty()) {
        attributes = static_cast<std::uint32_t>(first_triangle - rows);
        rows += count;
        append_indices(packed_.normal_indices, mesh.normal_indices, count, packed_.normals.size());
        if (!mesh.normal_indices.empty()) {
          for (const vec3& n : mesh.normals) packed_.normals.emplace_back(n, 0);
        }
        if (has_textures())
          append_indices(packed_.texcoord_indices, mesh.texcoord_indices, count,
                         packed_.texcoords.size());
        if (textured)
          packed_.texcoords.insert(packed_.texcoords.end(), mesh.texcoords.begin(),
                                   mesh.texcoords.end());
      }
      packed_.meshes.push_back({mesh.bsdf, mesh.emitter, attributes, 0});
      first_triangle += count;
    }
  }

  /// Tells each triangle its mesh and its index in the scene.
  void name_triangles() {
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      const std::uint32_t place = packed_.bvh.places[s];
      shared::PairRecord& pair = packed_.pairs[place / 2];
      std::uint32_t& name = place % 2 == 0 ? pair.name0 : pair.name1;
      name = (name & ~shared::NAME_INDEX_MASK) | sources_[s].id;
      (place % 2 == 0 ? pair.mesh0 : pair.mesh1) = sources_[s].mesh;
    }
    for (const CopiedLeaf& copy : packed_.bvh.copies)
      packed_.pairs[copy.item] = packed_.pairs[copy.original];
  }

  /// Places in the BVH of a mesh's triangles; 0 for those without area.
  [[nodiscard]] std::vector<std::uint32_t> places_of(std::uint32_t mesh) const {
    std::vector<std::uint32_t> places(scene_.meshes[mesh].position_indices.size(), 0);
    for (std::size_t s = first_source_[mesh]; s < first_source_[mesh + 1]; ++s)
      places[sources_[s].index] = packed_.bvh.places[s];
    return places;
  }

  void pack_emitters() {
    const double radius =
        sources_.empty() ? 1.0 : 0.5 * glm::length(dvec3(packed_.bvh.bounds.extent()));
    EmitterTable table = make_emitter_table(scene_, settings_, radius,
                                            [this](std::uint32_t mesh) { return places_of(mesh); });
    for (std::size_t e = 0; e < table.emitters.size(); ++e) {
      const auto* area = std::get_if<AreaEmitter>(&scene_.emitters[e]);
      if (area != nullptr) table.emitters[e].first_index = first_id_[area->mesh];
    }
    packed_.emitters = std::move(table.emitters);
    packed_.emitter_triangles = std::move(table.triangles);
    packed_.emitter_places = std::move(table.places);
    packed_.light_nodes = std::move(table.light_nodes);
    packed_.environment_texels = std::move(table.environment.texels);
    packed_.environment_rows = std::move(table.environment.rows);
    packed_.environment_columns = std::move(table.environment.columns);
    packed_.frame.environment_irradiance = table.environment_irradiance;
    packed_.frame.emitter_count = static_cast<std::uint32_t>(packed_.emitters.size());
    packed_.frame.environment_emitter = scene_.environment();
    if (scene_.environment() == none) return;
    const auto& sky = std::get<EnvironmentEmitter>(scene_.emitters[scene_.environment()]);
    packed_.frame.environment_width = static_cast<std::uint32_t>(sky.width);
    packed_.frame.environment_height = static_cast<std::uint32_t>(sky.height);
  }

  void pack_albedos() {
    const auto needs = [](const shared::BsdfRecord& b) {
      return (b.flags & shared::BSDF_MULTISCATTER) != 0;
    };
    if (std::none_of(packed_.bsdfs.begin(), packed_.bsdfs.end(), needs)) return;
    for (const bsdf::AlbedoTable& table : bsdf::albedo_tables())
      packed_.albedos.insert(packed_.albedos.end(), table.begin(), table.end());
  }

  /// Brings the brightest emitter near 1, so that squares of radiances neither over- nor underflow.
  void choose_square_scale() {
    float brightest = 0;
    for (const Emitter& emitter : scene_.emitters) {
      Color color(0);
      if (const auto* area = std::get_if<AreaEmitter>(&emitter)) color = area->emitted().value;
      if (const auto* point = std::get_if<PointLight>(&emitter)) color = point->intensity;
      brightest = std::max({brightest, color.r, color.g, color.b});
    }
    for (const glm::vec4& texel : packed_.environment_texels) {
      brightest = std::max({brightest, texel.r, texel.g, texel.b});
    }
    packed_.frame.square_scale =
        brightest > 0 ? std::ldexp(1.0F, -std::clamp(std::ilogb(brightest), -100, 100)) : 1.0F;
  }

  /// Intervals: offset and |filter| at both ends of each.
  void pack_filter() {
    const FilterTable table = make_filter_table(scene_.camera.filter);
    for (std::size_t i = 0; i < table.intervals(); ++i)
      packed_.filter_intervals.emplace_back(table.quantiles[i], table.quantiles[i + 1]);
    packed_.frame.filter_intervals = table.intervals();
    packed_.frame.filter_crossing = table.crossing;
    packed_.frame.filter_scale = table.scale;
  }

  void pack_frame() {
    const Camera c = camera_of(scene_, settings_);
    const glm::dmat3 linear(c.to_world);
    const double tangent = std::tan(glm::radians(c.fov) / 2);
    const double aspect = static_cast<double>(c.width) / c.height;
    shared::FrameRecord& f = packed_.frame;
    f.camera_origin = glm::vec4(vec3(dvec3(c.to_world[3])), c.near_clip);
    f.camera_corner = glm::vec4(vec3(linear * dvec3(tangent, tangent / aspect, 1)), c.far_clip);
    f.camera_dx = glm::vec4(vec3(linear[0] * (-2 * tangent / c.width)), 0);
    f.camera_dy = glm::vec4(vec3(linear[1] * (-2 * tangent / aspect / c.height)), 0);
    f.width = static_cast<std::uint32_t>(c.width);
    f.height = static_cast<std::uint32_t>(c.height);
    f.crop_x = static_cast<std::uint32_t>(settings_.crop.x0);
    f.crop_y = static_cast<std::uint32_t>(settings_.crop.y0);
    f.crop_width = static_cast<std::uint32_t>(settings_.crop_width());
    f.crop_height = static_cast<std::uint32_t>(settings_.crop_height());
    const int limit = settings_.integrator.interaction_limit();
    f.max_depth = limit < 0 ? shared::NONE : static_cast<std::uint32_t>(limit);
    constexpr double four_pi2 = 4 * std::numbers::pi * std::numbers::pi;
    f.simple_position = glm::vec4(settings_.integrator.position, 0);
    f.simple_energy = glm::vec4(vec3(dvec3(settings_.integrator.energy) / four_pi2), 0);
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  PackedScene packed_;
  std::vector<SourceTriangle> sources_;
  std::vector<std::size_t> first_source_;  ///< of each mesh, and the end
  std::vector<std::uint32_t> first_id_;    ///< of each mesh
  std::vector<TriangleCorners> corners_;
};

}  // namespace

PackedScene pack_scene(const Scene& scene, const RenderSettings& settings) {
  PackedScene packed = Packer(scene, settings).pack();
  packed.settings = settings;
  packed.features = find_features(scene, settings);
  for (const shared::EmitterTriangle& t : packed.emitter_triangles)
    packed.features.emitter_pieces |= t.corner == shared::NO_CORNER ? 1U : 2U;
  packed.features.light_tree = !packed.light_nodes.empty();
  return packed;
}

}  // namespace facet
