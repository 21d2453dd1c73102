#include "core/print.h"

namespace facet {

void put_text(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    put("{}", line);
    if (end == std::string_view::npos) return;
    put("\n");
    text.remove_prefix(end + 1);
  }
}

}  // namespace facet
