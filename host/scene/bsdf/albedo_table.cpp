#include "scene/bsdf/albedo_table.h"

namespace facet::bsdf {

namespace {

constexpr std::array<AlbedoTable, 3> tables{
#include "albedo_tables.inc"
};

}  // namespace

const std::array<AlbedoTable, 3>& albedo_tables() { return tables; }

const AlbedoTable& albedo_table(const MicrofacetOptions& options) {
  if (options.distribution == Distribution::ggx) return tables[shared::ALBEDO_GGX];
  return tables[options.masking == Masking::exact ? shared::ALBEDO_BECKMANN_EXACT
                                                  : shared::ALBEDO_BECKMANN_RATIONAL];
}

}  // namespace facet::bsdf
