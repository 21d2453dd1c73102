#pragma once
// Dispatch over the BSDFs of the shared list, and the guard that needs none of their sampling code.
#include <variant>

#include "reference/bsdf/diffuse.h"
#include "reference/bsdf/roughconductor.h"
#include "reference/bsdf/roughsubstrate.h"
#include "scene/bsdf/bsdf.h"

namespace facet::reference {

template <typename Real>
class AnyBsdf {
 public:
  AnyBsdf(const Bsdf& parameters, LobeSampling sampling)
      : uniform_(sampling == LobeSampling::uniform), model_(make(parameters, sampling)) {}

  /// Id of the shared list.
  [[nodiscard]] std::size_t type() const { return model_.index(); }

  /// f(wo, wi), sr^-1; both above the surface.
  template <typename Probe>
  Vec3<Real> eval(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    return std::visit([&](const auto& m) { return m.eval(wo, wi, probe); }, model_);
  }

  /// Density of wi under sample, sr^-1.
  template <typename Probe>
  Real pdf(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    if (uniform_) return 1 / (2 * pi<Real>);
    return std::visit([&](const auto& m) { return m.pdf(wo, wi, probe); }, model_);
  }

  template <typename Probe>
  BsdfSample<Real> sample(const Vec3<Real>& wo, const BsdfNumbers<Real>& n, Probe& probe) const {
    if (!uniform_) return std::visit([&](const auto& m) { return m.sample(wo, n, probe); }, model_);
    const Vec3<Real> wi = uniform_direction(n.u, n.v);
    return {wi, 1 / (2 * pi<Real>), wi.z > 0 ? eval(wo, wi, probe) * (2 * pi<Real> * wi.z) : Vec3<Real>(0)};
  }

 private:
  using Model = decltype(facet::detail::variant_without_first(std::variant<std::monostate
#define FACET_TYPE(name, Type, id) , Type<Real>
                                                                               FACET_BSDF_LIST(FACET_TYPE)
#undef FACET_TYPE
                                                                           >{}));

  static Model make(const Bsdf& parameters, LobeSampling sampling) {
    switch (parameters.index()) {
#define FACET_MAKE(name, Type, id) \
  case id:                         \
    return Model(std::in_place_index<id>, std::get<id>(parameters), sampling);
      FACET_BSDF_LIST(FACET_MAKE)
#undef FACET_MAKE
      default:
        std::abort();
    }
  }

  bool uniform_;
  Model model_;
};

}  // namespace facet::reference
