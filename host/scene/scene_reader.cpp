#include "scene/scene_reader.h"

#include "core/text.h"
#include "scene/emitter/readers.h"
#include "scene/mesh/mtl.h"
#include "scene/plugin/parameter_reader.h"
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
  c = read_parameters<Camera>(p);
  if (const auto filter = p.only_child("rfilter")) c.filter = read_filter(*filter);
  p.finish(diagnostics_);
}

Filter SceneReader::read_filter(const pugi::xml_node& node) {
  PropertyReader p = open(node);
  std::optional<Filter> filter;
  if (p.type() == "gaussian") filter = read_parameters<GaussianFilter>(p);
  if (p.type() == "mitchell") filter = read_parameters<MitchellFilter>(p);
  if (p.type() == "tent") filter = read_parameters<TentFilter>(p);
  if (p.type() == "box") filter = read_parameters<BoxFilter>(p);
  if (!filter) fail_unknown_type(p, "rfilter");
  p.finish(diagnostics_);
  return *filter;
}

void SceneReader::read_sampler(PropertyReader& scene) {
  const auto node = scene.only_child("sampler");
  if (!node) return;
  PropertyReader p = open(*node);
  const auto sampler = find_sampler(p.type());
  if (!sampler) forgive_unknown_type(p, "sampler", overridden_.sampler);
  scene_.sampler = sampler.value_or(scene_.sampler);
  const auto parameters = read_parameters<SamplerParameters>(p);
  scene_.sample_count = parameters.sample_count;
  scene_.seed = parameters.seed;
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
  scene_.integrator = read_parameters<Integrator>(p, {*type});
  p.finish(diagnostics_);
}

SceneReader::Surfaces SceneReader::read_surfaces(PropertyReader& p) {
  const auto bsdf = p.only_child("bsdf");
  if (p.type() == "memory" && used_memory_meshes_ < memory_meshes_.size())
    return {{std::move(memory_meshes_[used_memory_meshes_++])}, {read_bsdf(bsdf.value())}};
  if (p.type() != "obj") fail_unknown_type(p, "mesh");
  const auto [filename, to_world] = read_parameters<ObjParameters>(p);
  const std::filesystem::path path = xml_.path().parent_path() / filename;
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
    auto& diffuse = std::get<bsdf::Diffuse>(bsdfs.emplace_back(bsdf::Diffuse{}));
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
  if (p.type() == #name) bsdf = read_parameters<bsdf::Type>(p);
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
    scene_.emitters.emplace_back(read_parameters<PointLight>(p));
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
