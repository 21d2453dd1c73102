#include <dlfcn.h>
#include <link.h>

#include <algorithm>

#include "core/error.h"
#include "core/sanitized.h"
#include "core/text.h"
#include "gpu/requirements.h"
#include "gpu/vulkan.h"

namespace facet::gpu {

namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";
constexpr const char* driver_hint =
    "install a Vulkan driver: on Debian and Ubuntu the package mesa-vulkan-drivers holds those of "
    "AMD and "
    "Intel GPUs and lavapipe, "
    "which needs no GPU";

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* log) {
  auto* const validation = static_cast<ValidationLog*>(log);
  const std::scoped_lock lock(validation->mutex);
  validation->messages.emplace_back(data->pMessage);
  return VK_FALSE;
}

vk::raii::Context make_context() {
  try {
    return {};
  } catch (const std::exception&) {
    throw DeviceError(
        std::string("no Vulkan loader (libvulkan.so.1): install the package libvulkan1; and ") +
        driver_hint);
  }
}

bool has_layer(const vk::raii::Context& context, const char* name) {
  const auto layers = context.enumerateInstanceLayerProperties();
  return std::any_of(layers.begin(), layers.end(),
                     [&](const auto& l) { return std::string_view(l.layerName) == name; });
}

vk::raii::Instance make_instance(const vk::raii::Context& context, bool validate) {
  const vk::ApplicationInfo application("facet", 1, "facet", 1, minimum_api_version);
  std::vector<const char*> layers;
  std::vector<const char*> extensions;
  if (validate) {
    if (!has_layer(context, validation_layer)) {
      throw DeviceError("no validation layers: install the package vulkan-validationlayers");
    }
    layers.push_back(validation_layer);
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  }
  try {
    // Drivers that translate to another API are listed only on request. Old loaders refuse it; to
    // ask them beforehand would load and unload every driver once more.
    std::vector<const char*> all = extensions;
    all.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    try {
      return {context, vk::InstanceCreateInfo(vk::InstanceCreateFlagBits::eEnumeratePortabilityKHR,
                                              &application, layers, all)};
    } catch (const vk::ExtensionNotPresentError&) {
      return {context, vk::InstanceCreateInfo({}, &application, layers, extensions)};
    }
  } catch (const vk::SystemError& e) {
    throw DeviceError(fmt::format("no usable Vulkan driver ({}): {}", e.what(), driver_hint));
  }
}

vk::raii::DebugUtilsMessengerEXT make_messenger(const vk::raii::Instance& instance, bool validate,
                                                ValidationLog* log) {
  if (!validate) return nullptr;
  // Versions of Vulkan-Hpp differ in the type of the callback; the C structure's is the same in
  // all.
  VkDebugUtilsMessengerCreateInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                     VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = &on_message;
  info.pUserData = log;
  return {instance, vk::DebugUtilsMessengerCreateInfoEXT(info)};
}

/// Never unloads what is loaded by now. What drivers keep for the process is lost when they are
/// unloaded, and would be reported as leaks.
void keep_libraries_loaded() {
  const auto keep = [](dl_phdr_info* library, std::size_t /*size*/, void* /*data*/) {
    (void)::dlopen(library->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
    return 0;
  };
  (void)::dl_iterate_phdr(keep, nullptr);
}

}  // namespace

Instance::Instance(bool validate)
    : validation_(std::make_unique<ValidationLog>()),
      context_(make_context()),
      instance_(make_instance(context_, validate)),
      messenger_(make_messenger(instance_, validate, validation_.get())) {
  if (is_sanitized) keep_libraries_loaded();
}

std::vector<DeviceInfo> Instance::devices() const {
  return or_device_error("a Vulkan driver", "list its devices", [&] {
    std::vector<DeviceInfo> list;
    const vk::raii::PhysicalDevices physical(instance_);
    for (const vk::raii::PhysicalDevice& device : physical)
      list.push_back(describe_device(device, static_cast<std::uint32_t>(list.size())));
    return list;
  });
}

vk::raii::PhysicalDevice Instance::physical_device(const DeviceInfo& info) const {
  vk::raii::PhysicalDevices physical(instance_);
  return std::move(physical[info.index]);
}

std::vector<DeviceInfo> list_devices() { return Instance(false).devices(); }

DeviceInfo choose_device(const std::vector<DeviceInfo>& list, const std::string& selector) {
  if (list.empty()) throw DeviceError(std::string("no Vulkan device: ") + driver_hint);
  const auto index = parse_integer(selector);
  const DeviceInfo* best = nullptr;
  for (const DeviceInfo& device : list) {
    const bool named = lower_case(device.name).find(lower_case(selector)) != std::string::npos;
    const bool selected = selector.empty() || (index ? *index == device.index : named);
    if (!selected) continue;
    if (best == nullptr || best->rank < device.rank) best = &device;
  }
  if (best == nullptr) {
    throw DeviceError(
        fmt::format("no Vulkan device is \"{}\"; \"facet devices\" lists the {} there are",
                    selector, list.size()));
  }
  if (!best->lacks.empty()) {
    throw DeviceError(
        fmt::format("{} lacks {}; {}", best->name, fmt::join(best->lacks, ", "), driver_hint));
  }
  return *best;
}

}  // namespace facet::gpu
