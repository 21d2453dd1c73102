#include "render/features.h"

#include <algorithm>

#include "render/pack/parameter_records.h"
#include "shared/emitter_list.h"

namespace facet {

namespace {

const std::vector<std::string>& emitter_names() {
#define FACET_NAME(name, id) #name,
  static const std::vector<std::string> names{FACET_EMITTER_LIST(FACET_NAME)};
#undef FACET_NAME
  return names;
}

void add_bsdfs(Features& f, const std::vector<Bsdf>& bsdfs) {
  f.bsdf_flags_all = ~0U;
  for (const Bsdf& bsdf : bsdfs) {
    const std::uint32_t flags = pack_bsdf(bsdf).flags;
    const bool rough = std::visit(
        [](const auto& b) {
          return requires { b.options; };
        },
        bsdf);
    f.bsdf_mask |= 1U << bsdf.index();
    f.bsdf_flags_some |= flags;
    f.rough_bsdfs = f.rough_bsdfs || rough;
    // What does not know these flags does not care.
    f.bsdf_flags_all &= rough ? flags : flags | shared::BSDF_ROUGH_FLAGS;
  }
}

}  // namespace

Features find_features(const Scene& scene, const RenderSettings& settings) {
  Features f;
  add_bsdfs(f, bsdfs_of(scene, settings));
  for (const Texture& texture : scene.textures) {
    f.texture_kinds |= 1U << texture.index();
    const auto* bitmap = std::get_if<BitmapTexture>(&texture);
    if (bitmap != nullptr && !bitmap->colors.empty()) f.texture_kinds |= shared::TEXTURE_FLOATS;
  }
  for (const Emitter& emitter : scene.emitters) f.emitter_mask |= 1U << emitter.index();
  f.several_emitters = scene.emitters.size() > 1;
  f.shading_normals = std::any_of(scene.meshes.begin(), scene.meshes.end(),
                                  [](const Mesh& m) { return !m.normal_indices.empty(); });
  f.integrator = settings.integrator;
  f.sampler = settings.sampler;
  const int limit = settings.integrator.interaction_limit();
  f.roulette = limit < 0 || limit >= static_cast<int>(shared::ROULETTE_FIRST);
  f.variance = settings.variance;
  f.pixel_list = settings.goal().has_trial();
  f.negative_filter = ends_negative(scene.camera.filter);
  f.visible_normals = settings.sampling == LobeSampling::visible;
  // Without a single emitter there is nothing to sample.
  if (scene.emitters.empty()) f.integrator.type.emitter_sampling = false;
  return f;
}

std::array<std::uint32_t, shared::SPEC_COUNT> Features::constants(std::uint32_t stack_size) const {
  std::array<std::uint32_t, shared::SPEC_COUNT> c{};
  c[shared::SPEC_STACK_SIZE] = stack_size;
  c[shared::SPEC_BSDF_MASK] = bsdf_mask;
  c[shared::SPEC_EMITTER_MASK] = emitter_mask;
  c[shared::SPEC_SEVERAL_EMITTERS] = several_emitters ? 1 : 0;
  c[shared::SPEC_EMITTER_PIECES] = emitter_pieces;
  c[shared::SPEC_LIGHT_TREE] = light_tree ? 1 : 0;
  c[shared::SPEC_SOLID_ANGLE] = integrator.area_sampling == AreaSampling::solid_angle ? 1 : 0;
  c[shared::SPEC_SHADING_NORMALS] = shading_normals ? 1 : 0;
  c[shared::SPEC_INTEGRATOR] = static_cast<std::uint32_t>(integrator.type.kernel);
  c[shared::SPEC_EMITTER_SAMPLING] = integrator.type.emitter_sampling ? 1 : 0;
  c[shared::SPEC_MATERIAL_SAMPLING] = integrator.type.material_sampling ? 1 : 0;
  c[shared::SPEC_VISIBLE_NORMALS] = visible_normals ? 1 : 0;
  c[shared::SPEC_POWER_HEURISTIC] = integrator.heuristic == Heuristic::power ? 1 : 0;
  c[shared::SPEC_ROULETTE] = roulette ? 1 : 0;
  c[shared::SPEC_VARIANCE] = variance ? 1 : 0;
  c[shared::SPEC_PIXEL_LIST] = pixel_list ? 1 : 0;
  c[shared::SPEC_BSDF_FLAGS_SOME] = bsdf_flags_some;
  c[shared::SPEC_BSDF_FLAGS_ALL] = bsdf_flags_all;
  c[shared::SPEC_TEXTURE_KINDS] = texture_kinds;
  c[shared::SPEC_EVERY_EMITTER] = integrator.type.every_emitter ? 1 : 0;
  c[shared::SPEC_NEGATIVE_FILTER] = negative_filter ? 1 : 0;
  c[shared::SPEC_CANDIDATES] = static_cast<std::uint32_t>(integrator.candidates());
  c[shared::SPEC_ONLY_BOUNCE] = bounce_limit() == 1 ? 1 : 0;
  c[shared::SPEC_SAMPLER] = static_cast<std::uint32_t>(sampler);
  return c;
}

std::vector<std::string> Features::names() const {
  std::vector<std::string> list{std::string("integrator ") + std::string(integrator.type.name)};
  if (integrator.needs_emitters()) {
    for (std::size_t i = 0; i < bsdf_type_names.size(); ++i) {
      if ((bsdf_mask >> i & 1U) != 0) list.push_back("bsdf " + std::string(bsdf_type_names[i]));
    }
    for (std::size_t i = 0; i < emitter_names().size(); ++i) {
      if ((emitter_mask >> i & 1U) != 0) list.push_back("emitter " + emitter_names()[i]);
    }
    add_bsdf_choices(list);
    if (integrator.type.emitter_sampling && integrator.type.material_sampling) {
      list.emplace_back(integrator.heuristic == Heuristic::power ? "power heuristic"
                                                                 : "balance heuristic");
    }
    if (light_tree) list.emplace_back("light tree");
    if (integrator.candidates() > 1)
      list.push_back(fmt::format("{} candidates of an emitter sample", integrator.candidates()));
    if (roulette) list.emplace_back("roulette");
  }
  if (sampler != Sampler::independent) list.push_back("sampler " + std::string(name_of(sampler)));
  if (shading_normals) list.emplace_back("vertex normals");
  if (variance) list.emplace_back("variance");
  if (pixel_list) list.emplace_back("lists of pixels");
  if (negative_filter) list.emplace_back("negative filter");
  return list;
}

void Features::add_bsdf_choices(std::vector<std::string>& list) const {
  const auto some = [this](std::uint32_t flag) { return (bsdf_flags_some & flag) != 0; };
  if (rough_bsdfs) {
    list.emplace_back(visible_normals ? "visible-normal sampling" : "ndf sampling");
    if ((bsdf_flags_all & shared::BSDF_GGX) == 0) list.emplace_back("Beckmann distribution");
    if (some(shared::BSDF_GGX)) list.emplace_back("GGX distribution");
    if (some(shared::BSDF_EXACT_MASKING)) list.emplace_back("exact masking");
  }
  if (some(shared::BSDF_MULTISCATTER)) list.emplace_back("multiple scattering");
  if (some(shared::BSDF_DELTA)) list.emplace_back("delta lobes");
  if (some(shared::BSDF_TRANSMITS)) list.emplace_back("transmission");
  for (std::size_t i = 0; i < texture_type_names.size(); ++i) {
    if ((texture_kinds & 1U << i) != 0)
      list.push_back(fmt::format("texture {}", texture_type_names.at(i)));
  }
  if ((texture_kinds & shared::TEXTURE_FLOATS) != 0) list.emplace_back("texture textmap of floats");
}

Features Features::with_everything() const {
  Features f = *this;
  f.bsdf_mask = f.emitter_mask = f.bsdf_flags_some = f.texture_kinds = ~0U;
  f.bsdf_flags_all = 0;
  f.rough_bsdfs = f.shading_normals = f.negative_filter = f.several_emitters = true;
  f.emitter_pieces = 3;
  return f;
}

std::uint32_t Features::bounce_limit() const {
  if (!integrator.needs_emitters()) return 1;
  const int limit = integrator.interaction_limit();
  if (limit < 0) return 0;
  // After the last interaction a ray looks for emission, unless emitters are sampled alone.
  // So do delta lobes.
  const bool looks =
      integrator.type.material_sampling || (bsdf_flags_some & shared::BSDF_DELTA) != 0;
  return static_cast<std::uint32_t>(std::max(1, limit + (looks ? 1 : 0)));
}

bool Features::is_last_bounce(std::uint32_t bounce) const {
  const int limit = integrator.interaction_limit();
  return limit >= 0 && bounce >= static_cast<std::uint32_t>(limit);
}

}  // namespace facet
