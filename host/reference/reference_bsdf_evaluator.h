#pragma once
// One BSDF of the reference, evaluated and sampled in bulk.
#include "core/parallel.h"
#include "reference/bsdf/bsdf.h"
#include "reference/random.h"
#include "reference/texture.h"
#include "statistics/bsdf_evaluator.h"

namespace facet::reference {

/// A BSDF without textures. Inputs are the interface's floats; results are rounded to float at the
/// end.
template <typename Real>
class ReferenceBsdfEvaluator : public statistics::BsdfEvaluator {
 public:
  ReferenceBsdfEvaluator(Bsdf bsdf, LobeSampling sampling)
      : bsdf_(std::move(bsdf)), sampling_(sampling) {}

  [[nodiscard]] std::vector<statistics::BsdfValue> evaluate(
      std::span<const statistics::DirectionPair> pairs) override {
    std::vector<statistics::BsdfValue> values(pairs.size());
    parallel_for(pairs.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        values[i] = value(Vec3<Real>(pairs[i].wo), Vec3<Real>(pairs[i].wi));
    });
    return values;
  }

  [[nodiscard]] std::vector<statistics::BsdfDraw> sample(
      const vec3& wo, std::span<const statistics::BsdfNumbers> numbers) override {
    return draw_all(wo, numbers.size(), [&](std::size_t i) {
      const statistics::BsdfNumbers& n = numbers[i];
      return BsdfNumbers(word_of(n.lobe), word_of(n.u), word_of(n.v));
    });
  }

  [[nodiscard]] std::vector<statistics::BsdfDraw> sample(const vec3& wo, std::uint32_t count,
                                                         std::uint32_t seed) override {
    return draw_all(wo, count, [&](std::size_t i) {
      return BsdfNumbers(
          bounce_block({0, static_cast<std::uint32_t>(i), seed}, 1, shared::BOUNCE_BSDF));
    });
  }

 private:
  static constexpr std::size_t grain = 1U << 14U;

  /// Of a multiple of 2^-24.
  static std::uint32_t word_of(float number) {
    return static_cast<std::uint32_t>(number * 0x1p24F) << 8U;
  }

  /// The BSDF seen from wo's side.
  AnyBsdf<Real> seen_from(const Vec3<Real>& wo) const {
    Unwatched probe;
    const std::vector<Texture> no_textures;
    const Vec2<Real> origin(0);
    Parameters<Real, Unwatched> at(no_textures, origin, probe);
    AnyBsdf<Real> model(bsdf_, at, sampling_);
    if (wo.z < 0 && model.transmits()) model.turn_over();
    return model;
  }

  /// Paths end where a surface is seen from a side that it does not have.
  static bool has_side(const AnyBsdf<Real>& model, const Vec3<Real>& wo) {
    return wo.z > 0 || (model.transmits() && wo.z < 0);
  }

  statistics::BsdfValue value(const Vec3<Real>& wo, const Vec3<Real>& wi) const {
    const AnyBsdf<Real> model = seen_from(wo);
    if (!has_side(model, wo)) return {};
    Unwatched probe;
    return {vec3(model.eval(wo, wi, probe)), static_cast<float>(model.pdf(wo, wi, probe))};
  }

  template <typename Numbers>
  std::vector<statistics::BsdfDraw> draw_all(const vec3& wo, std::size_t count,
                                             const Numbers& numbers) const {
    const AnyBsdf<Real> model = seen_from(Vec3<Real>(wo));
    std::vector<statistics::BsdfDraw> draws(count);
    if (!has_side(model, Vec3<Real>(wo))) return draws;
    parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
      Unwatched probe;
      for (std::size_t i = begin; i < end; ++i) {
        const BsdfSample<Real> s = model.sample(Vec3<Real>(wo), numbers(i), probe);
        draws[i] = {vec3(s.wi), static_cast<float>(s.pdf), vec3(s.weight)};
      }
    });
    return draws;
  }

  Bsdf bsdf_;
  LobeSampling sampling_;
};

}  // namespace facet::reference
