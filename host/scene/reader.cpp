#include "scene/reader.h"

#include "core/memory.h"
#include "scene/scene_reader.h"

namespace facet {

Scene read_scene(const std::filesystem::path& path, Diagnostics& diagnostics,
                 const Overridden& overridden) {
  const Activity activity("reading the scene " + path.string());
  diagnostics.add_input({}, path);
  const XmlDocument xml(path);
  xml.add_inputs(diagnostics);
  const pugi::xml_node root = xml.root();
  if (std::string_view(root.name()) == "test") {
    throw InputError(xml.location(root),
                     fmt::format("this is a <test>; run it with: facet test {}", path.string()));
  }
  if (std::string_view(root.name()) != "scene") {
    throw InputError(xml.location(root),
                     fmt::format("the root is <{}>; <scene> expected", root.name()));
  }
  return SceneReader(xml, diagnostics, overridden).read(root);
}

void check_image_size(long long width, long long height) {
  if (width >= 1 && height >= 1 && width <= largest_image_side && height <= largest_image_side &&
      width * height <= largest_image_area)
    return;
  throw InputError(fmt::format(
      "an image of {}x{} pixels: sides must be 1 to {}, and the whole at most {} pixels", width,
      height, largest_image_side, largest_image_area));
}

}  // namespace facet
