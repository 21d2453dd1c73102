#pragma once
// Which part of the renderer failing samples have in common.
#include <map>

#include "parity/parity.h"

namespace facet::parity {

using reference::Feature;

/// Counts, for each part, the failing and the passing samples that use it.
class Spectrum {
 public:
  void add(const std::vector<Feature>& features, bool failing);
  void merge(const Spectrum& other);
  /// Sorted by score; empty where nothing failed.
  [[nodiscard]] std::vector<Suspect> suspects(const Scene& scene) const;

 private:
  struct Counts {
    std::uint64_t failing = 0;
    std::uint64_t passing = 0;
  };
  Counts all_;
  std::map<Feature, Counts> by_feature_;
};

}  // namespace facet::parity
