#pragma once
// What sampling an emitter gives.
#include "reference/random.h"
#include "reference/real.h"
#include "scene/scene.h"

namespace facet::reference {

/// Words of an emitter sample (docs/reference/sampling.md, "Emitter sample").
struct EmitterNumbers {
  std::uint32_t u = 0;
  std::uint32_t v = 0;
  std::uint32_t first_fill = 0;
  std::uint32_t second_fill = 0;

  explicit EmitterNumbers(const Block& block)
      : u(block.word(shared::EMITTER_U)),
        v(block.word(shared::EMITTER_V)),
        first_fill(block.word(shared::EMITTER_FIRST_FILL)),
        second_fill(block.word(shared::EMITTER_SECOND_FILL)) {}
};

template <typename Real>
struct EmitterSample {
  std::size_t emitter = 0;        ///< index into Scene::emitters
  Vec3<Real> direction{0, 0, 1};  ///< unit, from the surface point
  Vec3<Real> radiance{0};
  Real pdf = 0;  ///< sr^-1; of a point: the probability of the choice
  Vec3<Real> end{
      0};  ///< where the shadow ray ends, moved off the emitter; for emitters at a distance
  bool at_infinity = false;
  bool is_point = false;  ///< nothing else finds it
};

/// Emission found by a ray, and the density with which emitter sampling would have found it, sr^-1.
template <typename Real>
struct Found {
  std::uint32_t emitter = none;  ///< none: nothing emits there
  Vec3<Real> radiance{0};
  Real pdf = 0;
};

}  // namespace facet::reference
