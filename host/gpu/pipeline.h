#pragma once
// Compute pipelines and the bindings they share.
#include <array>
#include <span>
#include <vector>

#include "gpu/buffer.h"

namespace facet::gpu {

/// The layout that all kernels of a program share: buffers by binding number, and push constants.
class Layout {
 public:
  /// types: one a binding, from 0.
  Layout(const Device& device, std::span<const vk::DescriptorType> types,
         std::uint32_t push_constant_bytes);

  [[nodiscard]] const vk::raii::DescriptorSetLayout& set() const { return set_; }
  [[nodiscard]] const vk::raii::PipelineLayout& pipeline() const { return pipeline_; }
  [[nodiscard]] std::span<const vk::DescriptorType> types() const { return types_; }

 private:
  std::vector<vk::DescriptorType> types_;
  vk::raii::DescriptorSetLayout set_;
  vk::raii::PipelineLayout pipeline_;
};

/// What one binding is bound to: a storage buffer, or a texel buffer through its view.
struct Binding {
  const Buffer* buffer = nullptr;
  const vk::raii::BufferView* view = nullptr;
};

/// A descriptor set with everything bound.
class BindingSet {
 public:
  BindingSet(const Device& device, const Layout& layout, std::span<const Binding> bindings);
  [[nodiscard]] vk::DescriptorSet handle() const { return *set_; }

 private:
  vk::raii::DescriptorPool pool_;
  vk::raii::DescriptorSet set_;
};

/// A kernel without specialization constants, or with their default values.
[[nodiscard]] vk::raii::Pipeline make_compute_pipeline(const Device& device, const Layout& layout,
                                                       std::span<const std::uint32_t> code,
                                                       const std::string& name);

/// Makes everything written so far visible to later kernels, indirect commands, copies and the
/// host.
void barrier(const vk::raii::CommandBuffer& commands);

}  // namespace facet::gpu
