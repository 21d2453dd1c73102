#pragma once
// What a scene has: the kernels are specialised to it, and nothing else is compiled, uploaded or
// allocated.
#include <array>
#include <string>
#include <vector>

#include "scene/settings.h"
#include "shared/bindings.h"

namespace facet {

struct Features {
  std::uint32_t bsdf_mask = 0;        ///< bit id of the shared list
  std::uint32_t emitter_mask = 0;     ///< likewise
  std::uint32_t bsdf_flags_some = 0;  ///< flags of shared/records.h that some BSDF has
  std::uint32_t bsdf_flags_all = 0;   ///< that all have; of flags for rough BSDFs: all rough ones
  std::uint32_t texture_kinds = 0;    ///< bit 0: checker, bit 1: textmap, bit 2: textmap of floats
  bool rough_bsdfs = false;           ///< some BSDF has microfacets
  bool shading_normals = false;
  bool several_emitters = false;
  /// Bit 0: single triangles, bit 1: two as one. Packing finds out; find_features leaves it 0.
  std::uint32_t emitter_pieces = 0;
  bool light_tree = false;  ///< emitters are chosen by one; packing finds out, too
  bool roulette = false;
  bool variance = false;
  bool pixel_list = false;       ///< pixels are chosen one by one
  bool negative_filter = false;  ///< the reconstruction filter is negative in parts
  bool visible_normals = true;
  Integrator integrator;
  Sampler sampler = Sampler::independent;

  /// Values of the specialization constants.
  [[nodiscard]] std::array<std::uint32_t, shared::SPEC_COUNT> constants(
      std::uint32_t stack_size) const;
  /// In words, for `facet info` and reports.
  [[nodiscard]] std::vector<std::string> names() const;
  /// Bounces (rays one after another along a path) at most; 0: unlimited.
  [[nodiscard]] std::uint32_t bounce_limit() const;
  /// Whether the bounce, counted from 0, comes after the last interaction: its ray looks for
  /// emission alone.
  [[nodiscard]] bool is_last_bounce(std::uint32_t bounce) const;

  /// The same for kernels that leave nothing out but what the user decides: every BSDF, emitter and
  /// texture is in, and every attribute of meshes. The image is the same.
  [[nodiscard]] Features with_everything() const;

 private:
  void add_bsdf_choices(std::vector<std::string>& list) const;
};

[[nodiscard]] Features find_features(const Scene& scene, const RenderSettings& settings);

}  // namespace facet
