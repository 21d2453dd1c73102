#include "gpu/commands.h"

#include "gpu/program_handles.h"

namespace facet::gpu {

void Commands::fill(const Buffer& buffer, std::uint64_t first_byte, std::uint64_t bytes,
                    std::uint32_t word) {
  buffer_.fillBuffer(buffer.handle(), first_byte, bytes, word);
  barrier();
}

void Commands::copy(const Buffer& from, std::uint64_t from_byte, const Buffer& to,
                    std::uint64_t to_byte, std::uint64_t bytes) {
  buffer_.copyBuffer(from.handle(), to.handle(), vk::BufferCopy(from_byte, to_byte, bytes));
  barrier();
}

void Commands::bind(const BoundBuffers& buffers) {
  buffer_.bindDescriptorSets(vk::PipelineBindPoint::eCompute, buffers.handles().layout, 0,
                             *buffers.handles().set, {});
}

void Commands::use(const CompiledKernel& kernel, std::span<const std::byte> constants) {
  const CompiledKernel::Handles& handles = kernel.handles();
  buffer_.bindPipeline(vk::PipelineBindPoint::eCompute, *handles.pipeline);
  const vk::ArrayProxy<const std::byte> bytes(static_cast<std::uint32_t>(constants.size()),
                                              constants.data());
  buffer_.pushConstants<std::byte>(handles.layout, vk::ShaderStageFlagBits::eCompute, 0, bytes);
}

void Commands::dispatch(std::uint32_t workgroups) {
  buffer_.dispatch(workgroups, 1, 1);
  barrier();
}

void Commands::dispatch_indirect(const Buffer& counts, std::uint64_t first_byte) {
  buffer_.dispatchIndirect(counts.handle(), first_byte);
  barrier();
}

void Commands::barrier() {
  using Stage = vk::PipelineStageFlagBits;
  using Kind = vk::AccessFlagBits;
  const vk::MemoryBarrier all(Kind::eShaderWrite | Kind::eTransferWrite,
                              Kind::eShaderRead | Kind::eShaderWrite | Kind::eUniformRead |
                                  Kind::eIndirectCommandRead | Kind::eTransferRead |
                                  Kind::eTransferWrite | Kind::eHostRead);
  buffer_.pipelineBarrier(
      Stage::eComputeShader | Stage::eTransfer,
      Stage::eComputeShader | Stage::eDrawIndirect | Stage::eTransfer | Stage::eHost, {}, all, {},
      {});
}

}  // namespace facet::gpu
