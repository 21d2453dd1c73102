// make_albedo_table OUTPUT: integrates the directional albedo of rough microfacets with F = 1 and
// writes it as the initialisers of host/scene/bsdf/albedo_table.cpp. E(wo) = mean of G(wi,
// wo)/G1'(wo) over visible normals, G1' being what normalises them; wi below the horizon counts 0.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "reference/bsdf/microfacets.h"
#include "shared/records.h"

namespace {

using namespace facet;
using reference::Vec3;

/// Points x and weights w of Gauss and Legendre's rule over [0, 1].
struct GaussRule {
  std::vector<double> x;
  std::vector<double> w;

  /// The points are the zeros of Legendre's polynomial, found by Newton's method.
  explicit GaussRule(int count) : x(static_cast<std::size_t>(count)), w(x.size()) {
    for (int i = 0; i < count; ++i) {
      double z = std::cos(std::acos(-1.0) * (i + 0.75) / (count + 0.5));
      double slope = 0;
      for (int round = 0; round < 20; ++round) {
        double value = 1;
        double before = 0;
        for (int n = 0; n < count; ++n) {
          const double next = ((2 * n + 1) * z * value - n * before) / (n + 1);
          before = value;
          value = next;
        }
        slope = count * (z * value - before) / (z * z - 1);
        z -= value / slope;
      }
      x[static_cast<std::size_t>(i)] = (1 - z) / 2;
      w[static_cast<std::size_t>(i)] = 1 / ((1 - z * z) * slope * slope);
    }
  }
};

/// Right to 3e-4: the integrand has a kink where wi meets the horizon.
double albedo(double cosine, double alpha, const bsdf::MicrofacetOptions& options) {
  static const GaussRule along_u(96);
  static const GaussRule along_v(48);
  const reference::Microfacets<double> microfacets(alpha, options, LobeSampling::visible);
  reference::Unwatched probe;
  const Vec3<double> wo(std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine);
  double sum = 0;
  for (std::size_t i = 0; i < along_u.x.size(); ++i) {
    // Half of v is enough: the lobe is symmetric about the plane of incidence.
    for (std::size_t j = 0; j < along_v.x.size(); ++j) {
      const Vec3<double> h =
          microfacets.sample_half_vector(wo, along_u.x[i], along_v.x[j] / 2, probe);
      const double c = glm::dot(wo, h);
      const Vec3<double> wi = 2 * c * h - wo;
      if (c > 0 && wi.z > 0)
        sum += along_u.w[i] * along_v.w[j] * microfacets.half_vector_weight(wo, wi, h, c, probe);
    }
  }
  return sum;
}

void write_table(std::FILE* out, const bsdf::MicrofacetOptions& options) {
  std::fprintf(out, "AlbedoTable{\n");
  constexpr int n = shared::ALBEDO_NODES;
  for (int row = 0; row < n; ++row) {
    const double y = static_cast<double>(row) / (n - 1);
    const double alpha = std::max(y * y, 1e-4);
    for (int column = 0; column < n; ++column) {
      const double x = static_cast<double>(column) / (n - 1);
      // At cos 0 there is nothing to integrate; the last value that there is stands for the limit.
      const double cosine = std::max(alpha * x / (1 + alpha - x), 1e-3 * alpha);
      const double e = albedo(std::min(cosine, 1.0), alpha, options);
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
  write_table(out, {bsdf::Distribution::beckmann, Masking::rational});
  write_table(out, {bsdf::Distribution::beckmann, Masking::exact});
  write_table(out, {bsdf::Distribution::ggx, Masking::exact});
  return std::fclose(out) == 0 ? 0 : 1;
}
