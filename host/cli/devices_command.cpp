// facet devices: which Vulkan devices there are, what each lacks, which one is used and why.
#include <fmt/format.h>

#include "cli/backend_options.h"
#include "cli/commands.h"
#include "core/print.h"
#include "core/text.h"
#include "gpu/device.h"
#include "gpu/kernel_cache.h"

namespace facet::cli {

namespace {

ExitCode list_devices() {
  const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
  for (const gpu::DeviceInfo& d : devices) {
    put("{}: {}\n", d.index, d.name);
    put("   {}, {}, Vulkan {}, {}B of device memory\n", d.kind, d.driver, d.vulkan_version,
        with_unit_prefix(static_cast<double>(d.memory_bytes)));
    put("   {}\n", suitability(d));
    const std::string cache = gpu::describe_kernel_cache(d.driver);
    if (!cache.empty()) put("   {}\n", cache);
  }
  put("facet needs: {}\n", fmt::join(gpu::requirement_names(), ", "));
  const gpu::DeviceInfo chosen = gpu::choose_device(devices, "");
  const char* why = devices.size() == 1
                        ? "the only device"
                        : "the first of the best kind: discrete, then integrated, virtual, CPU";
  put("used: {}: {} ({}; --device chooses another)\n", chosen.index, chosen.name, why);
  return ExitCode::done;
}

}  // namespace

void add_devices_command(CommandLine& line) {
  line.add("devices", "List the Vulkan devices, what each lacks, and which one is used and why")
      .action(list_devices);
}

}  // namespace facet::cli
