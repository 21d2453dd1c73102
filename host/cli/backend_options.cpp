#include "cli/backend_options.h"

#include "core/error.h"

namespace facet::cli {

void add_device_option(CLI::App& command, std::string& device) {
  command.add_option("--device", device, "Vulkan device, by index or part of its name (see facet devices)");
}

void add_backend_options(CLI::App& command, std::string& backend, std::string& precision, std::string& device,
                         bool& validate) {
  command
      .add_option("--backend", backend,
                  "What computes: the kernels on a Vulkan device, or the reference on the CPU")
      ->check(CLI::IsMember({"vulkan", "reference"}))
      ->capture_default_str();
  command.add_option("--precision", precision, "Precision of the reference (default: float)")
      ->check(CLI::IsMember({"float", "double"}));
  add_device_option(command, device);
  command.add_flag("--validate", validate,
                   "Turn the Vulkan validation layers on; exit 1 on any message of theirs");
}

void check_backend_options(const std::string& backend, const std::string& precision,
                           const std::string& device, bool validate) {
  const bool reference = backend == "reference";
  if (!reference && !precision.empty())
    throw InputError("--precision belongs to --backend reference: kernels compute in float");
  if (reference && (!device.empty() || validate))
    throw InputError("--device and --validate belong to --backend vulkan: the reference uses the CPU alone");
}

}  // namespace facet::cli
