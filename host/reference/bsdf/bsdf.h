#pragma once
// Dispatch over the BSDFs of the shared list, and the guard that needs none of their sampling code.
#include <variant>

#include "generated/reference_bsdfs.h"
#include "scene/bsdf/bsdf.h"

namespace facet::reference {

/// A BSDF at a point, seen from one side.
template <typename Real>
class AnyBsdf {
 public:
  /// at: values of the parameters at the point.
  template <typename Parameters>
  AnyBsdf(const Bsdf& parameters, Parameters& at, LobeSampling sampling)
      : uniform_(sampling == LobeSampling::uniform), model_(make(parameters, at, sampling)) {}

  /// Id of the shared list.
  [[nodiscard]] std::size_t type() const { return model_.index(); }

  [[nodiscard]] bool transmits() const {
    return std::visit([](const auto& m) { return m.transmits; }, model_);
  }
  /// Whether it scatters into single directions only.
  [[nodiscard]] bool delta() const {
    return std::visit([](const auto& m) { return m.delta(); }, model_);
  }

  /// Where it transmits: wo now lies below.
  void turn_over() {
    turned_ = !turned_;
    visit_transmitting(*this, [](auto& m) { m.turn_over(); });
  }

  /// f(wo, wi), sr^-1; wo on the side that is seen. 0 where light cannot go, and for delta lobes.
  template <typename Probe>
  Vec3<Real> eval(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    if (!has_value(wi, probe)) return Vec3<Real>(0);
    return std::visit([&](const auto& m) { return m.eval(seen(wo), seen(wi), probe); }, model_);
  }

  /// Density of wi under sample, sr^-1.
  template <typename Probe>
  Real pdf(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    if (!has_value(wi, probe)) return 0;
    if (uniform_) return uniform_pdf();
    return std::visit([&](const auto& m) { return m.pdf(seen(wo), seen(wi), probe); }, model_);
  }

  template <typename Probe>
  BsdfSample<Real> sample(const Vec3<Real>& wo, const BsdfNumbers& n, Probe& probe) const {
    if (uniform_ && !delta()) return sample_uniformly(wo, n, probe);
    BsdfSample<Real> s =
        std::visit([&](const auto& m) { return m.sample(seen(wo), n, probe); }, model_);
    s.wi = seen(s.wi);
    return s;
  }

 private:
  using Model =
      decltype(facet::detail::variant_without_first(std::variant<std::monostate
#define FACET_TYPE(name, Type, id) , Type<Real>
                                                                     FACET_BSDF_LIST(FACET_TYPE)
#undef FACET_TYPE
                                                                 >{}));

  template <typename Parameters>
  static Model make(const Bsdf& parameters, Parameters& at, LobeSampling sampling) {
    switch (parameters.index()) {
#define FACET_MAKE(name, Type, id) \
  case id:                         \
    return Model(std::in_place_index<id>, std::get<id>(parameters), at, sampling);
      FACET_BSDF_LIST(FACET_MAKE)
#undef FACET_MAKE
      default:
        std::abort();
    }
  }

  /// The model's view of a direction.
  [[nodiscard]] Vec3<Real> seen(const Vec3<Real>& w) const {
    return {w.x, w.y, turned_ ? -w.z : w.z};
  }

  template <typename Probe>
  [[nodiscard]] bool has_value(const Vec3<Real>& wi, Probe& probe) const {
    return !delta() && (transmits() || is_above(seen(wi), probe));
  }

  [[nodiscard]] Real uniform_pdf() const { return 1 / ((transmits() ? 4 : 2) * pi<Real>); }

  template <typename Probe>
  BsdfSample<Real> sample_uniformly(const Vec3<Real>& wo, const BsdfNumbers& n,
                                    Probe& probe) const {
    const Vec3<Real> wi = uniform_direction(n.u<Real>(), n.v<Real>(), Real(transmits() ? 2 : 1));
    BsdfSample<Real> s{wi, uniform_pdf(), eval(wo, wi, probe) * (std::abs(wi.z) / uniform_pdf())};
    if (!is_above(seen(wi), probe))
      visit_transmitting(*this, [&](const auto& m) { s.eta2 = m.eta2(); });
    return s;
  }

  template <typename Self, typename Function>
  static void visit_transmitting(Self& self, const Function& f) {
    std::visit(
        [&](auto& m) {
          if constexpr (std::decay_t<decltype(m)>::transmits) f(m);
        },
        self.model_);
  }

  bool uniform_;
  bool turned_ = false;
  Model model_;
};

}  // namespace facet::reference
