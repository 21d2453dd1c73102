#include "reference/probe.h"

#include <array>

#include "shared/random_hash.h"

namespace facet::reference {

const char* decision_name(DecisionKind kind) {
  constexpr std::array names{
      "edge",   "order",    "range",   "frame",       "horizon",           "emission",
      "offset", "lobe",     "masking", "tail",        "reflectance",       "cell",
      "texel",  "roulette", "light",   "solid angle", "solid angle share", "candidate"};
  return names.at(static_cast<std::size_t>(kind));
}

bool Watch::decide(DecisionKind kind, std::uint64_t item, bool outcome, double margin) {
  const DecisionKey key{kind, ray_, emitter_, item};
  const auto forced = forced_.find(key);
  if (forced != forced_.end()) outcome = forced->second;
  decisions_[key] = {outcome, margin};
  return outcome;
}

std::uint32_t Watch::random_bits(std::uint32_t component) const {
  return shared::pcg4d({perturbation_, nudges_, component, 0}).x;
}

}  // namespace facet::reference
