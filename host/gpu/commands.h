#pragma once
// What a submission does.
#include <span>

#include "gpu/program.h"

namespace vk::raii {
class CommandBuffer;
}

namespace facet::gpu {

/// Records commands, each of which sees all that those before it have written; the host sees what
/// the last has.
class Commands {
 public:
  explicit Commands(const vk::raii::CommandBuffer& buffer) : buffer_(buffer) {}

  /// Sets every word of a part of a buffer.
  void fill(const Buffer& buffer, std::uint64_t first_byte, std::uint64_t bytes,
            std::uint32_t word);
  void copy(const Buffer& from, std::uint64_t from_byte, const Buffer& to, std::uint64_t to_byte,
            std::uint64_t bytes);

  /// The buffers of the kernels that follow.
  void bind(const BoundBuffers& buffers);
  /// Runs workgroups of a kernel with push constants.
  template <typename Constants>
  void dispatch(const CompiledKernel& kernel, const Constants& constants,
                std::uint32_t workgroups) {
    use(kernel, std::as_bytes(std::span(&constants, 1)));
    dispatch(workgroups);
  }
  /// As many workgroups as three words of a buffer say.
  template <typename Constants>
  void dispatch_indirect(const CompiledKernel& kernel, const Constants& constants,
                         const Buffer& counts, std::uint64_t first_byte) {
    use(kernel, std::as_bytes(std::span(&constants, 1)));
    dispatch_indirect(counts, first_byte);
  }

  [[nodiscard]] const vk::raii::CommandBuffer& handle() const { return buffer_; }

 private:
  void use(const CompiledKernel& kernel, std::span<const std::byte> constants);
  void dispatch(std::uint32_t workgroups);
  void dispatch_indirect(const Buffer& counts, std::uint64_t first_byte);
  void barrier();

  const vk::raii::CommandBuffer& buffer_;
};

}  // namespace facet::gpu
