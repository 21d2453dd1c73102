// What is built where Embree is not installed.
#include "bench/yardstick.h"

namespace facet::bench {

std::string yardstick_name() { return ""; }

std::unique_ptr<Yardstick> make_yardstick(const PackedScene& /*packed*/) { return nullptr; }

}  // namespace facet::bench
