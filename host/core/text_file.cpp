#include "core/text_file.h"

#include <cstdio>

#include "core/atomic_file.h"

namespace facet {

void write_text(const std::string& target, const std::string& text) {
  if (target == "-") {
    (void)std::fwrite(text.data(), 1, text.size(), stdout);
    return;
  }
  AtomicFile file(target);
  file.write(text);
  file.commit();
}

}  // namespace facet
