#include "gpu/program.h"

#include "core/error.h"
#include "gpu/program_handles.h"
#include "gpu/specialise.h"

namespace facet::gpu {

namespace {

vk::DescriptorType descriptor_type(Access access) {
  switch (access) {
    case Access::uniform:
      return vk::DescriptorType::eUniformBuffer;
    case Access::texels:
      return vk::DescriptorType::eStorageTexelBuffer;
    default:
      return vk::DescriptorType::eStorageBuffer;
  }
}

vk::raii::DescriptorSetLayout make_set_layout(const vk::raii::Device& device,
                                              const std::vector<Slot>& slots) {
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  bindings.reserve(slots.size());
  for (const Slot& slot : slots) {
    bindings.emplace_back(slot.binding, descriptor_type(slot.access), 1,
                          vk::ShaderStageFlagBits::eCompute);
  }
  return {device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::PipelineLayout make_pipeline_layout(const vk::raii::Device& device,
                                              const vk::raii::DescriptorSetLayout& set,
                                              std::uint32_t push_constant_bytes) {
  const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, push_constant_bytes);
  const vk::DescriptorSetLayout handle = *set;
  return {device, vk::PipelineLayoutCreateInfo({}, handle, range)};
}

vk::raii::DescriptorPool make_pool(const vk::raii::Device& device, const std::vector<Slot>& slots) {
  std::vector<vk::DescriptorPoolSize> sizes;
  sizes.reserve(slots.size());
  for (const Slot& slot : slots) sizes.emplace_back(descriptor_type(slot.access), 1);
  return {device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                               1, sizes)};
}

vk::raii::DescriptorSet make_set(const vk::raii::Device& device,
                                 const vk::raii::DescriptorPool& pool,
                                 vk::DescriptorSetLayout layout) {
  vk::raii::DescriptorSets sets(device, vk::DescriptorSetAllocateInfo(*pool, layout));
  return std::move(sets.front());
}

/// RGBA32UI, over the whole buffer.
vk::raii::BufferView make_texel_view(const vk::raii::Device& device, const Buffer& buffer) {
  return {device, vk::BufferViewCreateInfo({}, buffer.handle(), vk::Format::eR32G32B32A32Uint, 0,
                                           VK_WHOLE_SIZE)};
}

}  // namespace

CompiledKernel::CompiledKernel(std::unique_ptr<Handles> handles) : handles_(std::move(handles)) {}
CompiledKernel::~CompiledKernel() = default;
CompiledKernel::CompiledKernel(CompiledKernel&&) noexcept = default;
CompiledKernel& CompiledKernel::operator=(CompiledKernel&&) noexcept = default;
std::size_t CompiledKernel::instruction_count() const { return handles_->instruction_count; }

BoundBuffers::BoundBuffers(std::unique_ptr<Handles> handles) : handles_(std::move(handles)) {}
BoundBuffers::~BoundBuffers() = default;
BoundBuffers::BoundBuffers(BoundBuffers&&) noexcept = default;
BoundBuffers& BoundBuffers::operator=(BoundBuffers&&) noexcept = default;

struct Program::Layout {
  vk::raii::DescriptorSetLayout set;
  vk::raii::PipelineLayout pipeline;
};

Program::Program(const Device& device, const std::vector<Slot>& slots,
                 std::uint32_t push_constant_bytes)
    : device_(device), slots_(slots) {
  const vk::raii::Device& handle = device.vulkan().device;
  layout_ = or_device_error(device.info().name, "lay bindings out", [&] {
    auto set = make_set_layout(handle, slots);
    auto pipeline = make_pipeline_layout(handle, set, push_constant_bytes);
    return std::make_unique<Layout>(Layout{std::move(set), std::move(pipeline)});
  });
}

Program::~Program() = default;

CompiledKernel Program::compile(std::span<const std::uint32_t> code,
                                std::span<const std::uint32_t> constants,
                                const std::string& name) const {
  const std::vector<std::uint32_t> special = specialise(code, constants, name);
  const vk::raii::Device& device = device_.vulkan().device;
  return or_device_error(device_.info().name, "compile the kernel " + name, [&] {
    const vk::raii::ShaderModule module(
        device, vk::ShaderModuleCreateInfo({}, special.size() * 4, special.data()));
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module,
                                                  "main");
    vk::raii::Pipeline pipeline(device, nullptr,
                                vk::ComputePipelineCreateInfo({}, stage, *layout_->pipeline));
    return CompiledKernel(std::make_unique<CompiledKernel::Handles>(CompiledKernel::Handles{
        std::move(pipeline), *layout_->pipeline, gpu::instruction_count(special)}));
  });
}

void Program::check(const Buffer& buffer, Access access) const {
  const Device::Limits& limits = device_.limits();
  const std::uint64_t most = access == Access::storage   ? limits.storage_buffer_bytes
                             : access == Access::uniform ? limits.uniform_buffer_bytes
                                                         : limits.texel_buffer_texels * 16;
  if (buffer.size() > most) {
    throw InputError(fmt::format("{}: {} bytes are more than {} can bind ({})", buffer.name(),
                                 buffer.size(), device_.info().name, most));
  }
}

BoundBuffers Program::bind(const BufferMap& buffers) const {
  return or_device_error(device_.info().name, "bind buffers", [&] { return bound(buffers); });
}

BoundBuffers Program::bound(const BufferMap& buffers) const {
  const vk::raii::Device& device = device_.vulkan().device;
  auto pool = make_pool(device, slots_);
  auto set = make_set(device, pool, *layout_->set);
  std::vector<vk::raii::BufferView> views;
  for (const Slot& slot : slots_) {
    const Buffer& buffer = *buffers.at(slot.binding);
    check(buffer, slot.access);
    const vk::DescriptorBufferInfo whole(buffer.handle(), 0, VK_WHOLE_SIZE);
    vk::WriteDescriptorSet write(*set, slot.binding, 0, 1, descriptor_type(slot.access));
    vk::BufferView view;
    if (slot.access == Access::texels) {
      view = *views.emplace_back(make_texel_view(device, buffer));
      write.pTexelBufferView = &view;
    } else {
      write.pBufferInfo = &whole;
    }
    device.updateDescriptorSets(write, {});
  }
  return BoundBuffers(std::make_unique<BoundBuffers::Handles>(BoundBuffers::Handles{
      std::move(pool), std::move(set), *layout_->pipeline, std::move(views)}));
}

}  // namespace facet::gpu
