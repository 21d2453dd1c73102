#include "scene/scene_reader.h"

#include <glm/gtc/matrix_access.hpp>

#include "core/text.h"
#include "core/words.h"
#include "scene/emitter/readers.h"
#include "scene/mesh/mtl.h"
#include "scene/plugins.h"
#include "scene/reader.h"
#include "scene/texture/reader.h"

namespace facet {

Scene SceneReader::read(const pugi::xml_node& node, std::vector<Mesh> memory_meshes) && {
  memory_meshes_ = std::move(memory_meshes);
  return std::move(*this).read(node);
}

Scene SceneReader::read(const pugi::xml_node& node) && {
  PropertyReader properties(xml_, node);
  read_camera(properties);
  read_sampler(properties);
  read_integrator(properties);
  for (const pugi::xml_node& mesh : properties.children("mesh")) read_mesh(mesh);
  for (const pugi::xml_node& emitter : properties.children("emitter")) read_emitter(emitter);
  properties.finish(diagnostics_);
  return std::move(scene_);
}

void SceneReader::read_camera(PropertyReader& scene) {
  const auto node = scene.only_child("camera");
  if (!node) throw InputError(scene.location(), "the scene has no camera");
  PropertyReader p = open(*node);
  if (p.type() != "perspective") fail_unknown_type(p, "camera");
  Camera& c = scene_.camera;
  c.width = p.integer("width", c.width, 1, largest_image_side);
  c.height = p.integer("height", c.height, 1, largest_image_side);
  if (static_cast<long long>(c.width) * c.height > largest_image_area) {
    p.fail("width", fmt::format("and height make an image of {}x{}, more than {} pixels", c.width,
                                c.height, largest_image_area));
  }
  c.to_world = p.transform("toWorld");
  if (glm::determinant(glm::dmat3(c.to_world)) == 0) p.fail("toWorld", "is not invertible");
  if (glm::row(c.to_world, 3) != glm::dvec4(0, 0, 0, 1))
    p.fail("toWorld", "is projective: its last row must be 0 0 0 1");
  c.fov = p.real_above("fov", c.fov, 0);
  if (c.fov >= 180) p.fail("fov", fmt::format("is {:g} degrees, but must be less than 180", c.fov));
  c.near_clip = p.real("nearClip", c.near_clip);
  if (c.near_clip < 0) p.fail("nearClip", "must not be negative");
  c.far_clip = p.real_above("farClip", c.far_clip, c.near_clip);
  if (const auto filter = p.only_child("rfilter")) c.filter = read_filter(*filter);
  p.finish(diagnostics_);
}

Filter SceneReader::read_filter(const pugi::xml_node& node) {
  PropertyReader p = open(node);
  Filter filter;
  if (p.type() == "gaussian") {
    GaussianFilter f;
    f.radius = p.real_between("radius", f.radius, 0.01, 100);
    f.stddev = p.real_between("stddev", f.stddev, 0.01, 100);
    filter = f;
  } else if (p.type() == "mitchell") {
    MitchellFilter f;
    f.radius = p.real_between("radius", f.radius, 0.01, 100);
    f.b = p.real_between("B", f.b, -10, 10);
    f.c = p.real_between("C", f.c, -10, 10);
    filter = f;
    if (!is_bell(filter))
      p.fail("C",
             fmt::format(
                 "with B = {} and C = {} the filter is not positive first and negative beyond; "
                 "B from 0 to 1 and C from 0 to 1 are usual",
                 f.b, f.c));
  } else if (p.type() == "tent") {
    filter = TentFilter{};
  } else if (p.type() == "box") {
    filter = BoxFilter{};
  } else {
    fail_unknown_type(p, "rfilter");
  }
  p.finish(diagnostics_);
  return filter;
}

void SceneReader::read_sampler(PropertyReader& scene) {
  const auto node = scene.only_child("sampler");
  if (!node) return;
  PropertyReader p = open(*node);
  const auto sampler = find_sampler(p.type());
  if (!sampler) forgive_unknown_type(p, "sampler", overridden_.sampler);
  scene_.sampler = sampler.value_or(scene_.sampler);
  scene_.sample_count = p.integer("sampleCount", 1, 1, 1 << 30);
  scene_.seed = static_cast<std::uint32_t>(p.integer("seed", 0, 0, 0x7fffffff));
  p.finish(diagnostics_);
}

void SceneReader::forgive_unknown_type(const PropertyReader& p, const std::string& tag,
                                       bool overridden) {
  if (!overridden) fail_unknown_type(p, tag);
  diagnostics_.warn(p.location(),
                    fmt::format("{}: unknown type, replaced by --{}", p.title(), tag));
}

void SceneReader::read_integrator(PropertyReader& scene) {
  const auto node = scene.only_child("integrator");
  if (!node) return;
  PropertyReader p = open(*node);
  const auto type = find_integrator_type(p.type());
  if (!type) {
    forgive_unknown_type(p, "integrator", overridden_.integrator);
    return;
  }
  // The name lives in the table, not in the file's text.
  scene_.integrator.type = *type;
  if (p.type() == "simple") {
    scene_.integrator.position = p.point("position", scene_.integrator.position);
    scene_.integrator.energy = p.radiance("energy", scene_.integrator.energy);
  }
  if (scene_.integrator.needs_emitters()) {
    scene_.integrator.max_depth = p.integer("maxDepth", -1, -1, 1 << 30);
    scene_.integrator.heuristic =
        value_of(heuristic_words, p.choice("heuristic", names_of(heuristic_words))).value();
  }
  p.finish(diagnostics_);
}

SceneReader::Surfaces SceneReader::read_surfaces(PropertyReader& p) {
  const auto bsdf = p.only_child("bsdf");
  if (p.type() == "memory" && used_memory_meshes_ < memory_meshes_.size())
    return {{std::move(memory_meshes_[used_memory_meshes_++])}, {read_bsdf(bsdf.value())}};
  if (p.type() != "obj") fail_unknown_type(p, "mesh");
  const std::string filename = p.string("filename", "");
  if (filename.empty()) throw InputError(p.location(), "mesh \"obj\" lacks a filename");
  const std::filesystem::path path = xml_.path().parent_path() / filename;
  const dmat4 to_world = p.transform("toWorld");
  if (bsdf) return {{read_obj(path, to_world, p.location(), diagnostics_)}, {read_bsdf(*bsdf)}};
  ObjParts parts = read_obj_by_material(path, to_world, p.location(), diagnostics_);
  std::vector<Bsdf> bsdfs = read_materials(parts, path.parent_path(), p.location());
  return {std::move(parts.meshes), std::move(bsdfs)};
}

void SceneReader::read_mesh(const pugi::xml_node& node) {
  PropertyReader p = open(node);
  Surfaces surfaces = read_surfaces(p);
  std::optional<AreaEmitter> emitter;
  if (const auto child = p.only_child("emitter")) emitter = read_mesh_emitter(*child);
  p.finish(diagnostics_);
  for (std::size_t i = 0; i < surfaces.meshes.size(); ++i) {
    Mesh& mesh = scene_.meshes.emplace_back(std::move(surfaces.meshes[i]));
    mesh.bsdf = static_cast<std::uint32_t>(scene_.bsdfs.size());
    scene_.bsdfs.push_back(surfaces.bsdfs[i]);
    if (!emitter) continue;
    mesh.emitter = static_cast<std::uint32_t>(scene_.emitters.size());
    emitter->mesh = static_cast<std::uint32_t>(scene_.meshes.size() - 1);
    scene_.emitters.emplace_back(*emitter);
  }
}

AreaEmitter SceneReader::read_mesh_emitter(const pugi::xml_node& node) {
  PropertyReader p = open_textured(node);
  if (p.type() != "area") {
    if (p.type() == "environment" || p.type() == "pointlight") {
      throw InputError(p.location(),
                       fmt::format("{} belongs to the scene, not to a mesh", p.title()));
    }
    fail_unknown_type(p, "emitter");
  }
  AreaEmitter emitter = read_area_emitter(p, none);
  p.finish(diagnostics_);
  return emitter;
}

std::uint32_t SceneReader::read_material_texture(const std::filesystem::path& map,
                                                 const std::string& material,
                                                 const SourceLocation& where) {
  try {
    scene_.textures.emplace_back(read_material_map(map, where, diagnostics_));
  } catch (const InputError& e) {
    diagnostics_.warn(where,
                      fmt::format("material \"{}\": {}; its colour stands in", material, e.what()));
    return none;
  }
  return static_cast<std::uint32_t>(scene_.textures.size() - 1);
}

std::vector<Bsdf> SceneReader::read_materials(const ObjParts& parts,
                                              const std::filesystem::path& folder,
                                              const SourceLocation& where) {
  std::vector<Bsdf> bsdfs;
  if (parts.material_files.empty()) return {parts.meshes.size(), bsdf::Diffuse{}};
  const auto materials = read_mtl(parts.material_files, folder, where, diagnostics_);
  std::map<std::filesystem::path, std::uint32_t> textures;
  std::vector<std::string> unknown;
  for (const std::string& name : parts.materials) {
    bsdf::Diffuse& diffuse = std::get<bsdf::Diffuse>(bsdfs.emplace_back(bsdf::Diffuse{}));
    const auto material = materials.find(name);
    if (material == materials.end()) {
      if (!name.empty() && !materials.empty()) unknown.push_back(name);
      continue;
    }
    const auto& [color, map] = material->second;
    diffuse.albedo = color;
    if (map.empty()) continue;
    const auto [texture, is_new] = textures.try_emplace(map, none);
    if (is_new) texture->second = read_material_texture(map, name, where);
    diffuse.albedo.texture = texture->second;
  }
  if (!unknown.empty()) {
    diagnostics_.warn(
        where,
        fmt::format("no materials file defines \"{}\"{}", unknown.front(),
                    unknown.size() > 1 ? fmt::format(" and {} more", unknown.size() - 1) : ""));
  }
  if (!materials.empty()) {
    diagnostics_.warn(
        where,
        fmt::format("the mesh has no <bsdf>: the diffuse colours and textures of {} are used, "
                    "and nothing else of its materials",
                    fmt::join(parts.material_files, ", ")));
  }
  return bsdfs;
}

Bsdf SceneReader::read_bsdf(const pugi::xml_node& node) {
  PropertyReader p = open_textured(node);
  std::optional<Bsdf> bsdf;
#define FACET_READ(name, Type, id) \
  if (p.type() == #name) bsdf = bsdf::Type::read(p);
  FACET_BSDF_LIST(FACET_READ)
#undef FACET_READ
  if (!bsdf) fail_unknown_type(p, "bsdf");
  p.finish(diagnostics_);
  return *bsdf;
}

void SceneReader::read_emitter(const pugi::xml_node& node) {
  PropertyReader p = open(node);
  if (p.type() == "area")
    throw InputError(p.location(), "emitter \"area\" belongs to a mesh, not to the scene");
  if (p.type() == "environment") {
    if (scene_.environment() != none)
      throw InputError(p.location(), "the scene has more than one environment");
    scene_.emitters.emplace_back(read_environment_emitter(p, diagnostics_));
  } else if (p.type() == "pointlight") {
    scene_.emitters.emplace_back(read_point_light(p));
  } else {
    fail_unknown_type(p, "emitter");
  }
  p.finish(diagnostics_);
}

PropertyReader SceneReader::open_textured(const pugi::xml_node& node) {
  (void)open(node);
  return {xml_, node,
          [this](const pugi::xml_node& texture, float most) { return add_texture(texture, most); }};
}

std::uint32_t SceneReader::add_texture(const pugi::xml_node& node, float most) {
  PropertyReader p = open(node);
  Texture texture = read_texture(p, diagnostics_);
  p.finish(diagnostics_);
  if (maximum(texture) > most) {
    throw InputError(p.location(),
                     fmt::format("{} reaches {:g}, but \"{}\" lies between 0 and {:g}", p.title(),
                                 maximum(texture), node.attribute("name").value(), most));
  }
  scene_.textures.push_back(std::move(texture));
  return static_cast<std::uint32_t>(scene_.textures.size() - 1);
}

PropertyReader SceneReader::open(const pugi::xml_node& node) const {
  if (!node.attribute("type")) {
    throw InputError(xml_.location(node),
                     fmt::format("<{}> lacks the attribute \"type\"", node.name()));
  }
  return {xml_, node};
}

}  // namespace facet
