#include "scene/emitter/environment.h"

#include "image/files.h"
#include "scene/emitter/readers.h"
#include "scene/plugin/parameter_reader.h"
#include "scene/texture/color_map.h"

namespace facet {

EnvironmentEmitter read_environment_emitter(PropertyReader& properties, Diagnostics& diagnostics) {
  const auto [filename, radiance, encoding] = read_parameters<EnvironmentParameters>(properties);
  if (filename.empty()) return {1, 1, {radiance}};
  const std::filesystem::path path = properties.xml().path().parent_path() / filename;
  ColorImage map;
  try {
    map = color_image(read_image(path), path);
  } catch (const InputError& e) {
    throw InputError(properties.location(), e.what());
  }
  // The lab's renderer divides the map by 255 whatever it holds; its scenes make up for it in
  // `radiance`.
  const Color factor = encoding == Encoding::linear ? radiance : radiance / 255.0F;
  scale_and_clamp(map, factor, path, properties.location(), diagnostics);
  return {map.width, map.height, std::move(map.pixels)};
}

}  // namespace facet
