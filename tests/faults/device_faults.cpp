// A Vulkan layer (VK_LAYER_FACET_faults) that lets one of the program's calls of a device fail, as
// tests/faults/fault.h says. HOW: the VkResult as a number; by default
// VK_ERROR_OUT_OF_DEVICE_MEMORY, and VK_ERROR_DEVICE_LOST where a call waits for the device.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <array>
#include <utility>

#include "fault.h"

namespace {

using facet::faults::Counter;

/// The functions that can fail, and how they do by default.
#define FUNCTIONS(X)                                          \
  X(vkAllocateMemory, VK_ERROR_OUT_OF_DEVICE_MEMORY)          \
  X(vkBindBufferMemory, VK_ERROR_OUT_OF_DEVICE_MEMORY)        \
  X(vkMapMemory, VK_ERROR_MEMORY_MAP_FAILED)                  \
  X(vkCreateBuffer, VK_ERROR_OUT_OF_HOST_MEMORY)              \
  X(vkCreateBufferView, VK_ERROR_OUT_OF_HOST_MEMORY)          \
  X(vkCreateDescriptorSetLayout, VK_ERROR_OUT_OF_HOST_MEMORY) \
  X(vkCreatePipelineLayout, VK_ERROR_OUT_OF_HOST_MEMORY)      \
  X(vkCreateShaderModule, VK_ERROR_OUT_OF_HOST_MEMORY)        \
  X(vkCreatePipelineCache, VK_ERROR_OUT_OF_HOST_MEMORY)       \
  X(vkCreateComputePipelines, VK_ERROR_OUT_OF_DEVICE_MEMORY)  \
  X(vkCreateDescriptorPool, VK_ERROR_OUT_OF_DEVICE_MEMORY)    \
  X(vkAllocateDescriptorSets, VK_ERROR_OUT_OF_POOL_MEMORY)    \
  X(vkCreateCommandPool, VK_ERROR_OUT_OF_HOST_MEMORY)         \
  X(vkAllocateCommandBuffers, VK_ERROR_OUT_OF_DEVICE_MEMORY)  \
  X(vkCreateFence, VK_ERROR_OUT_OF_HOST_MEMORY)               \
  X(vkCreateQueryPool, VK_ERROR_OUT_OF_DEVICE_MEMORY)         \
  X(vkBeginCommandBuffer, VK_ERROR_OUT_OF_DEVICE_MEMORY)      \
  X(vkEndCommandBuffer, VK_ERROR_OUT_OF_DEVICE_MEMORY)        \
  X(vkResetCommandBuffer, VK_ERROR_OUT_OF_DEVICE_MEMORY)      \
  X(vkQueueSubmit, VK_ERROR_DEVICE_LOST)                      \
  X(vkWaitForFences, VK_ERROR_DEVICE_LOST)                    \
  X(vkResetFences, VK_ERROR_OUT_OF_DEVICE_MEMORY)             \
  X(vkGetQueryPoolResults, VK_ERROR_DEVICE_LOST)              \
  X(vkDeviceWaitIdle, VK_ERROR_DEVICE_LOST)                   \
  X(vkCreateDevice, VK_ERROR_INITIALIZATION_FAILED)           \
  X(vkCreateInstance, VK_ERROR_OUT_OF_HOST_MEMORY)

enum Function : std::size_t {
#define X(name, result) of_##name,
  FUNCTIONS(X)
#undef X
      function_count
};

constinit std::array<Counter, function_count> counters{
#define X(name, result) Counter(#name),
    FUNCTIONS(X)
#undef X
};

[[gnu::destructor]] void write_all() { facet::faults::write_counts(counters); }

std::array<PFN_vkVoidFunction, function_count> next_functions{};
PFN_vkGetInstanceProcAddr next_instance_proc = nullptr;
PFN_vkGetDeviceProcAddr next_device_proc = nullptr;

constexpr std::array<VkResult, function_count> usual_results{
#define X(name, result) result,
    FUNCTIONS(X)
#undef X
};

/// The result of the call where it is to fail, else VK_SUCCESS.
VkResult fault_of(Function function) {
  const char* how = counters[function].next();
  if (how == nullptr) return VK_SUCCESS;
  return *how != '\0' ? static_cast<VkResult>(std::atoi(how)) : usual_results[function];
}

/// A function with a call counted, and refused where it is the one.
template <Function function, typename Pointer>
struct Counted;
template <Function function, typename... Arguments>
struct Counted<function, VkResult (*)(Arguments...)> {
  static VkResult call(Arguments... arguments) {
    if (const VkResult result = fault_of(function); result != VK_SUCCESS) return result;
    return reinterpret_cast<VkResult (*)(Arguments...)>(next_functions[function])(arguments...);
  }
};

/// The link to the next layer that the loader hands down, advanced.
template <typename Info, typename CreateInfo>
Info* take_link(const CreateInfo* create, VkStructureType type) {
  auto* info = static_cast<Info*>(const_cast<void*>(create->pNext));
  while (info != nullptr && !(info->sType == type && info->function == VK_LAYER_LINK_INFO))
    info = static_cast<Info*>(const_cast<void*>(info->pNext));
  return info;
}

VkResult create_instance(const VkInstanceCreateInfo* create, const VkAllocationCallbacks* allocator,
                         VkInstance* instance) {
  if (const VkResult result = fault_of(of_vkCreateInstance); result != VK_SUCCESS) return result;
  auto* info =
      take_link<VkLayerInstanceCreateInfo>(create, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  next_instance_proc = info->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  info->u.pLayerInfo = info->u.pLayerInfo->pNext;
  return reinterpret_cast<PFN_vkCreateInstance>(next_instance_proc(nullptr, "vkCreateInstance"))(
      create, allocator, instance);
}

VkResult create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* create,
                       const VkAllocationCallbacks* allocator, VkDevice* device) {
  if (const VkResult result = fault_of(of_vkCreateDevice); result != VK_SUCCESS) return result;
  auto* info =
      take_link<VkLayerDeviceCreateInfo>(create, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  const auto instance_proc = info->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  next_device_proc = info->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  info->u.pLayerInfo = info->u.pLayerInfo->pNext;
  return reinterpret_cast<PFN_vkCreateDevice>(instance_proc(nullptr, "vkCreateDevice"))(
      physical, create, allocator, device);
}

PFN_vkVoidFunction device_proc(VkDevice device, const char* name);
PFN_vkVoidFunction instance_proc(VkInstance instance, const char* name);

/// Ours for the functions that are counted, else null.
PFN_vkVoidFunction own_function(const char* name, VkDevice device) {
  const auto is = [&](const char* other) { return std::strcmp(name, other) == 0; };
  if (is("vkGetInstanceProcAddr")) return reinterpret_cast<PFN_vkVoidFunction>(instance_proc);
  if (is("vkGetDeviceProcAddr")) return reinterpret_cast<PFN_vkVoidFunction>(device_proc);
  if (is("vkCreateInstance")) return reinterpret_cast<PFN_vkVoidFunction>(create_instance);
  if (is("vkCreateDevice")) return reinterpret_cast<PFN_vkVoidFunction>(create_device);
  if (device == VK_NULL_HANDLE) return nullptr;
#define X(function, result)                                                                    \
  if (is(#function)) {                                                                         \
    next_functions[of_##function] = next_device_proc(device, name);                            \
    return reinterpret_cast<PFN_vkVoidFunction>(Counted<of_##function, PFN_##function>::call); \
  }
  FUNCTIONS(X)
#undef X
  return nullptr;
}

PFN_vkVoidFunction device_proc(VkDevice device, const char* name) {
  const PFN_vkVoidFunction own = own_function(name, device);
  return own != nullptr ? own : next_device_proc(device, name);
}

PFN_vkVoidFunction instance_proc(VkInstance instance, const char* name) {
  const PFN_vkVoidFunction own = own_function(name, VK_NULL_HANDLE);
  if (own != nullptr) return own;
  return next_instance_proc != nullptr ? next_instance_proc(instance, name) : nullptr;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) VkResult vkNegotiateLoaderLayerInterfaceVersion(
    VkNegotiateLayerInterface* negotiation) {
  negotiation->loaderLayerInterfaceVersion = 2;
  negotiation->pfnGetInstanceProcAddr = instance_proc;
  negotiation->pfnGetDeviceProcAddr = device_proc;
  negotiation->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
