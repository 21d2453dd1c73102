#include "core/text_file.h"

#include "core/atomic_file.h"
#include "core/print.h"

namespace facet {

void write_text(const std::string& target, const std::string& text) {
  if (target == "-") {
    put("{}", text);
    return;
  }
  AtomicFile file(target);
  file.write(text);
  file.commit();
}

}  // namespace facet
