#pragma once
// Kernels that see the same buffers: their layout, specialisation and bindings.
#include <map>

#include "gpu/buffer.h"

namespace facet::gpu {

/// How kernels see a buffer.
enum class Access { uniform, storage, texels };

/// A binding of a program's kernels.
struct Slot {
  std::uint32_t binding = 0;
  Access access = Access::storage;
};

/// A compiled kernel.
class CompiledKernel {
 public:
  struct Handles;
  explicit CompiledKernel(std::unique_ptr<Handles> handles);
  ~CompiledKernel();
  CompiledKernel(CompiledKernel&&) noexcept;
  CompiledKernel& operator=(CompiledKernel&&) noexcept;

  /// Of its SPIR-V.
  [[nodiscard]] std::size_t instruction_count() const;
  [[nodiscard]] const Handles& handles() const { return *handles_; }

 private:
  std::unique_ptr<Handles> handles_;
};

/// Buffers in all slots of a program.
class BoundBuffers {
 public:
  struct Handles;
  explicit BoundBuffers(std::unique_ptr<Handles> handles);
  ~BoundBuffers();
  BoundBuffers(BoundBuffers&&) noexcept;
  BoundBuffers& operator=(BoundBuffers&&) noexcept;

  [[nodiscard]] const Handles& handles() const { return *handles_; }

 private:
  std::unique_ptr<Handles> handles_;
};

/// The buffer of each slot, by its binding.
using BufferMap = std::map<std::uint32_t, const Buffer*>;

/// What kernels that see the same buffers have in common.
class Program {
 public:
  /// The device has to outlive this.
  Program(const Device& device, const std::vector<Slot>& slots, std::uint32_t push_constant_bytes);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// A kernel, from SPIR-V and the values of its specialization constants (specialise.h); `name` is
  /// for messages. May be called by several threads at a time. Throws DeviceError.
  [[nodiscard]] CompiledKernel compile(std::span<const std::uint32_t> code,
                                       std::span<const std::uint32_t> constants,
                                       const std::string& name) const;

  /// Binds a buffer to every slot; the buffers have to outlive what is returned. Throws InputError
  /// where one is larger than the device can bind.
  [[nodiscard]] BoundBuffers bind(const BufferMap& buffers) const;

 private:
  [[nodiscard]] BoundBuffers bound(const BufferMap& buffers) const;
  struct Layout;
  void check(const Buffer& buffer, Access access) const;

  const Device& device_;
  std::vector<Slot> slots_;
  std::unique_ptr<Layout> layout_;
};

}  // namespace facet::gpu
