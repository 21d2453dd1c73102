#pragma once
// Compiled kernels, kept for the next render that needs the same.
#include <list>
#include <memory>

#include "render/render_kernels.h"

namespace facet {

/// The kernels of a render and the program that they belong to.
struct RenderProgram {
  /// Nothing is compiled yet.
  RenderProgram(const gpu::Device& device, GeometryFetch fetch, const Features& features,
                std::uint32_t stack_size);

  KernelProgram program;
  RenderKernels kernels;
};

/// Of one device, which has to outlive it.
class KernelStore {
 public:
  /// The program for such features: one that is held, or a new one, which is held from now on in
  /// place of that which has not been asked for the longest.
  [[nodiscard]] std::shared_ptr<RenderProgram> find_or_make(const gpu::Device& device,
                                                            GeometryFetch fetch,
                                                            const Features& features,
                                                            std::uint32_t stack_size);

 private:
  /// All that kernels are specialised to.
  struct Key {
    GeometryFetch fetch;
    int interaction_limit;  ///< says which bounces are the first and the last
    std::array<std::uint32_t, shared::SPEC_COUNT> constants;
    bool operator==(const Key&) const = default;
  };
  struct Entry {
    Key key;
    std::shared_ptr<RenderProgram> program;
  };
  std::list<Entry> entries_;  ///< that which was asked for last is the first
};

}  // namespace facet
