// make_albedo_table OUTPUT: integrates the directional albedo of rough microfacets with F = 1 and writes it
// as the initialisers of host/scene/bsdf/albedo_table.cpp. E(wo) = mean of G(wi, wo)/G1'(wo) over visible
// normals, G1' being what normalises them; wi below the horizon counts 0.
#include <algorithm>
#include <cstdio>

#include "reference/bsdf/microfacets.h"
#include "shared/records.h"

namespace {

using namespace facet;
using reference::Vec3;

/// Points along each axis of the midpoint rule over the numbers (u, v) of a sample.
constexpr int points = 96;

double albedo(double cosine, double alpha, const bsdf::MicrofacetOptions& options) {
  const reference::Microfacets<double> microfacets(alpha, options, LobeSampling::visible);
  reference::Unwatched probe;
  const Vec3<double> wo(std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine);
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    // Half of v is enough: the lobe is symmetric about the plane of incidence.
    for (int j = 0; j < points / 2; ++j) {
      const Vec3<double> h =
          microfacets.sample_half_vector(wo, (i + 0.5) / points, (j + 0.5) / points, probe);
      const double c = glm::dot(wo, h);
      const Vec3<double> wi = 2 * c * h - wo;
      if (c > 0 && wi.z > 0) sum += microfacets.half_vector_weight(wo, wi, h, c, probe);
    }
  }
  return sum / (0.5 * points * points);
}

void write_table(std::FILE* out, const bsdf::MicrofacetOptions& options) {
  std::fprintf(out, "AlbedoTable{\n");
  constexpr int n = shared::ALBEDO_NODES;
  for (int row = 0; row < n; ++row) {
    const double y = static_cast<double>(row) / (n - 1);
    for (int column = 0; column < n; ++column) {
      const double x = static_cast<double>(column) / (n - 1);
      // At cos 0 there is nothing to integrate; the last value that there is stands for the limit.
      const double e = albedo(std::max(x * x, 1e-4), std::max(y * y, 1e-4), options);
      std::fprintf(out, "%#.7gF,%c", e, column % 8 == 7 ? '\n' : ' ');
    }
  }
  std::fprintf(out, "},\n");
}

}  // namespace

int main(int argc, char** argv) {
  std::FILE* out = argc == 2 ? std::fopen(argv[1], "w") : nullptr;
  if (out == nullptr) {
    std::fprintf(stderr, "usage: make_albedo_table OUTPUT\n");
    return 2;
  }
  write_table(out, {bsdf::Distribution::beckmann, bsdf::Masking::rational});
  write_table(out, {bsdf::Distribution::beckmann, bsdf::Masking::exact});
  write_table(out, {bsdf::Distribution::ggx, bsdf::Masking::exact});
  return std::fclose(out) == 0 ? 0 : 1;
}
