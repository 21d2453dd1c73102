#include "gpu/pipeline.h"

#include "core/error.h"

namespace facet::gpu {

namespace {

vk::raii::DescriptorSetLayout make_set_layout(const Device& device,
                                              std::span<const vk::DescriptorType> types) {
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (const vk::DescriptorType type : types) {
    bindings.emplace_back(static_cast<std::uint32_t>(bindings.size()), type, 1,
                          vk::ShaderStageFlagBits::eCompute);
  }
  return {device.handle(), vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::PipelineLayout make_pipeline_layout(const Device& device,
                                              const vk::raii::DescriptorSetLayout& set,
                                              std::uint32_t push_constant_bytes) {
  const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, push_constant_bytes);
  const vk::DescriptorSetLayout handle = *set;
  return {device.handle(), vk::PipelineLayoutCreateInfo({}, handle, range)};
}

vk::raii::DescriptorPool make_pool(const Device& device,
                                   std::span<const vk::DescriptorType> types) {
  std::vector<vk::DescriptorPoolSize> sizes;
  for (const vk::DescriptorType type : types) sizes.emplace_back(type, 1);
  return {device.handle(), vk::DescriptorPoolCreateInfo(
                               vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes)};
}

vk::raii::DescriptorSet make_set(const Device& device, const vk::raii::DescriptorPool& pool,
                                 const Layout& layout) {
  const vk::DescriptorSetLayout handle = *layout.set();
  vk::raii::DescriptorSets sets(device.handle(), vk::DescriptorSetAllocateInfo(*pool, handle));
  return std::move(sets.front());
}

}  // namespace

Layout::Layout(const Device& device, std::span<const vk::DescriptorType> types,
               std::uint32_t push_constant_bytes)
    : types_(types.begin(), types.end()),
      set_(make_set_layout(device, types)),
      pipeline_(make_pipeline_layout(device, set_, push_constant_bytes)) {}

BindingSet::BindingSet(const Device& device, const Layout& layout,
                       std::span<const Binding> bindings)
    : pool_(make_pool(device, layout.types())), set_(make_set(device, pool_, layout)) {
  for (std::uint32_t i = 0; i < bindings.size(); ++i) {
    const vk::DescriptorBufferInfo buffer(bindings[i].buffer->handle(), 0, VK_WHOLE_SIZE);
    vk::WriteDescriptorSet write(*set_, i, 0, 1, layout.types()[i]);
    vk::BufferView view;
    if (bindings[i].view != nullptr) {
      view = **bindings[i].view;
      write.pTexelBufferView = &view;
    } else {
      write.pBufferInfo = &buffer;
    }
    device.handle().updateDescriptorSets(write, {});
  }
}

vk::raii::Pipeline make_compute_pipeline(const Device& device, const Layout& layout,
                                         std::span<const std::uint32_t> code,
                                         const std::string& name) {
  try {
    const vk::raii::ShaderModule module(
        device.handle(), vk::ShaderModuleCreateInfo({}, code.size_bytes(), code.data()));
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module,
                                                  "main");
    return {device.handle(), nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout.pipeline())};
  } catch (const vk::SystemError& e) {
    throw DeviceError(
        fmt::format("{} cannot compile the kernel {}: {}", device.info().name, name, e.what()));
  }
}

void barrier(const vk::raii::CommandBuffer& commands) {
  using Stage = vk::PipelineStageFlagBits;
  using Access = vk::AccessFlagBits;
  const vk::MemoryBarrier all(Access::eShaderWrite | Access::eTransferWrite,
                              Access::eShaderRead | Access::eShaderWrite | Access::eUniformRead |
                                  Access::eIndirectCommandRead | Access::eTransferRead |
                                  Access::eTransferWrite | Access::eHostRead);
  commands.pipelineBarrier(
      Stage::eComputeShader | Stage::eTransfer,
      Stage::eComputeShader | Stage::eDrawIndirect | Stage::eTransfer | Stage::eHost, {}, all, {},
      {});
}

}  // namespace facet::gpu
