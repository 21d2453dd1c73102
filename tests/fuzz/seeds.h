#pragma once
// The seed corpus: small files of every kind that is read, made by this program's own writers and
// by hand.
#include <string>
#include <vector>

namespace facet::fuzz {

struct Seed {
  std::string target;  ///< whose corpus it belongs to
  std::string name;
  std::string bytes;
  bool companion = false;  ///< lies beside every input, for scenes to refer to
};

[[nodiscard]] std::vector<Seed> seeds();

}  // namespace facet::fuzz
