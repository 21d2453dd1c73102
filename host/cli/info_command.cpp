// facet info: what a scene holds, and what will be compiled for it; or what of the scene language
// is supported.
#include <fmt/format.h>

#include <map>
#include <memory>

#include "cli/commands.h"
#include "cli/outputs.h"
#include "cli/reading_options.h"
#include "core/print.h"
#include "core/text.h"
#include "door/warnings.h"
#include "image/record.h"
#include "parts/checkpoint.h"
#include "parts/missing.h"
#include "render/features.h"
#include "render/pack/packed_scene.h"
#include "scene/manuals.h"
#include "scene/plugins.h"
#include "scene/reader.h"

namespace facet::cli {

namespace {

struct InfoOptions {
  std::string scene;
  std::optional<std::string> plugin;  ///< empty: all of them
  bool supported = false;
  ReadingRules reading;
};

void print_supported() {
  std::map<std::string_view, std::vector<std::string_view>> by_tag;
  for (const PluginInfo& plugin : plugins()) by_tag[plugin.tag].push_back(plugin.type);
  put("supported:\n");
  for (const auto& [tag, types] : by_tag) put("  {:<11} {}\n", tag, fmt::join(types, ", "));
}

void print_plugins(const std::string& name) {
  if (name.empty()) {
    for (const Manual& m : manuals()) {
      const std::string names(m.names.substr(1, m.names.size() - 2));
      put("{:<11} {}: {}\n", m.kind, fmt::join(split_list(names), ", "), m.summary);
    }
    return;
  }
  std::vector<std::string> known;
  for (const Manual& m : manuals()) {
    for (const std::string_view other : split_list(m.names)) known.emplace_back(other);
    if (!m.is_about(name)) continue;
    put("{} \"{}\": ", m.kind, name);
    put_text(full_text(m));
    return;
  }
  throw InputError(
      fmt::format("info: --plugins \"{}\": no such plugin{}", name, did_you_mean(name, known)));
}

/// Names of channels, those of a layer as one.
std::vector<std::string> channel_groups(const std::vector<std::string>& channels) {
  std::vector<std::string> groups;
  for (const std::string& channel : channels) {
    const std::size_t end = channel.find('.');
    const std::string group = end == std::string::npos ? channel : channel.substr(0, end) + ".*";
    if (groups.empty() || groups.back() != group) groups.push_back(group);
  }
  return groups;
}

std::string describe(const Mesh& mesh, const Scene& scene) {
  const std::string_view bsdf = bsdf_type_names[scene.bsdfs[mesh.bsdf].index()];
  return fmt::format("{}: {} triangles, {}{}{}", mesh.name, mesh.position_indices.size(), bsdf,
                     mesh.normal_indices.empty() ? "" : ", vertex normals",
                     mesh.emitter == none ? "" : ", emits");
}

std::string describe(const Emitter& emitter, const Scene& scene) {
  if (const auto* area = std::get_if<AreaEmitter>(&emitter))
    return fmt::format("area emitter {}", scene.meshes[area->mesh].name);
  if (const auto* point = std::get_if<PointLight>(&emitter))
    return fmt::format("point light at {:g}, {:g}, {:g}", point->position.x, point->position.y,
                       point->position.z);
  const auto& sky = std::get<EnvironmentEmitter>(emitter);
  return fmt::format("environment {} x {}", sky.width, sky.height);
}

/// ", part 3 of 16 of tile 1 of 4" of what is divided into several; nothing for other parts.
std::string describe_share(const PartFile& part) {
  if (!part.record.division) return "";
  const Division& d = *part.record.division;
  const auto share = find_share(d, part.record.samples.hull(), part.pixels());
  if (!share || part.record.samples.list().size() > 1) return "";
  return ", " + describe({*share}, d);
}

/// What continues or follows a render whose image this is.
void print_what_next(const PartFile& part) {
  if (is_checkpoint(part.header)) {
    put("a checkpoint, after {}; this continues it:\n  {}\n", describe_progress(part),
        continue_command(part));
  } else if (part.has_channel("sum.R")) {
    put("a part{}: facet merge joins it with others of this render\n", describe_share(part));
  } else if (part.record.stopped_by == StoppedBy::interrupt) {
    put("an image of a render that was interrupted\n");
  } else {
    put("a whole image\n");
  }
}

/// What an image file says of its making.
ExitCode print_image_info(const std::string& file) {
  const PartFile image{file, read_exr_header(file), {}};
  const ExrHeader& h = image.header;
  put("{}: {} x {} pixels", file, h.width, h.height);
  if (h.width != h.window.full_width || h.height != h.window.full_height)
    put(" from ({}, {}) on of {} x {}", h.window.x, h.window.y, h.window.full_width,
        h.window.full_height);
  put("; channels: {}\n", fmt::join(channel_groups(h.channels), ", "));
  const ParsedRecord parsed = parse_record(h.metadata);
  if (parsed.record.version.empty()) {
    put("not rendered by facet\n");
    return ExitCode::done;
  }
  for (const RecordField& field : record_fields()) {
    const auto value = field.read(parsed.record);
    if (value && !parsed.is_missing(field)) put("  {:<30} {}\n", field.label, *value);
  }
  print_what_next({file, h, parsed.record});
  return ExitCode::done;
}

ExitCode print_info(const InfoOptions& options) {
  if (options.supported) print_supported();
  if (options.plugin) print_plugins(*options.plugin);
  if (options.scene.empty()) {
    if (!options.supported && !options.plugin)
      throw InputError("info: a scene file, or --supported or --plugins, is needed");
    return ExitCode::done;
  }
  if (lower_case(std::filesystem::path(options.scene).extension().string()) == ".exr")
    return print_image_info(options.scene);
  Diagnostics diagnostics(options.reading);
  const Scene scene = read_scene(options.scene, diagnostics);
  const bool has_integrator = !scene.integrator.type.name.empty();
  RenderRequest request;
  // Some integrator shows what the scene needs of memory.
  if (!has_integrator) request.integrator = "path_mis";
  const RenderSettings settings = resolve(scene, request);
  if (has_integrator) warn_about_render(scene, settings, diagnostics);
  print_warnings(diagnostics);
  const PackedScene packed = pack_scene(scene, settings);
  const std::size_t geometry = bytes_of(packed.items) + bytes_of(packed.pairs) +
                               bytes_of(packed.normal_indices) + bytes_of(packed.normals) +
                               bytes_of(packed.texcoord_indices) + bytes_of(packed.texcoords);
  const std::size_t rest = bytes_of(packed.environment_texels) + bytes_of(packed.environment_rows) +
                           bytes_of(packed.environment_columns) +
                           bytes_of(packed.emitter_triangles) + bytes_of(packed.texels);
  put("{}: {} x {} pixels, {} samples ({}), {}\n", options.scene, scene.camera.width,
      scene.camera.height, scene.sample_count, name_of(scene.sampler),
      has_integrator ? scene.integrator.type.name : "no integrator");
  put("meshes: {}, triangles: {} ({} with area)\n", scene.meshes.size(), scene.triangle_count(),
      packed.triangle_count());
  for (const Mesh& mesh : scene.meshes) put("  {}\n", describe(mesh, scene));
  put("bsdfs: {}, textures: {}, emitters: {}\n", scene.bsdfs.size(), scene.textures.size(),
      scene.emitters.size());
  for (std::size_t i = 0; i < scene.emitters.size(); ++i) {
    put("  {}: chosen with probability {:.3g}\n", describe(scene.emitters[i], scene),
        packed.emitters[i].probability);
  }
  put("BVH: {} nodes, SAH cost {:.3g}, stack of {}, built in {:.3f} s\n", packed.bvh.node_count,
      packed.bvh.sah_cost, packed.bvh.stack_size, packed.bvh_seconds);
  put("device memory: geometry {}B ({:.1f} a triangle), emitters and textures {}B\n",
      with_unit_prefix(static_cast<double>(geometry)),
      packed.triangle_count() == 0
          ? 0.0
          : static_cast<double>(geometry) / static_cast<double>(packed.triangle_count()),
      with_unit_prefix(static_cast<double>(rest)));
  if (has_integrator) put("compiled for it: {}\n", fmt::join(packed.features.names(), ", "));
  return ExitCode::done;
}

}  // namespace

void add_info_command(CommandLine& line) {
  const auto options = std::make_shared<InfoOptions>();
  Command command = line.add("info", "Show what a scene holds and what will be compiled for it");
  command.argument("scene", options->scene,
                   "Scene file (XML); or an EXR: how it was made, and what continues a checkpoint",
                   false);
  command.flag("--supported", options->supported, "List the plugins of the scene language");
  command.optional_text("--plugins", options->plugin, "[NAME]",
                        "List the plugins in a line each, or print the manual of NAME");
  add_reading_options(command, options->reading);
  command.action([options] { return print_info(*options); });
}

}  // namespace facet::cli
