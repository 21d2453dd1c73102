#pragma once
// The Vulkan objects of kernels and bound buffers; for this room's source files alone.
#include "gpu/program.h"
#include "gpu/vulkan.h"

namespace facet::gpu {

struct CompiledKernel::Handles {
  vk::raii::Pipeline pipeline;
  vk::PipelineLayout layout;
  std::size_t instruction_count = 0;
};

struct BoundBuffers::Handles {
  vk::raii::DescriptorPool pool;
  vk::raii::DescriptorSet set;
  vk::PipelineLayout layout;
  std::vector<vk::raii::BufferView> views;  ///< of what is seen as texels
};

}  // namespace facet::gpu
