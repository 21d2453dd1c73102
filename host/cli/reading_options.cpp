#include "cli/reading_options.h"

namespace facet::cli {

void add_reading_options(Command& command, ReadingRules& rules) {
  command.flag("--strict", rules.strict, "Warnings are errors");
  command.path("--assets-below", rules.assets_below,
               "Refuse scenes, meshes, materials and textures whose files are not in or below this "
               "folder, links resolved");
}

}  // namespace facet::cli
