#include "cli/backend_options.h"

#include "core/error.h"

namespace facet::cli {

BackendOptions BackendChoice::options() const {
  if (!is_reference()) {
    if (!precision.empty())
      throw InputError("--precision belongs to --backend reference: kernels compute in float");
    return {.device = device, .validate = validate};
  }
  if (!device.empty() || validate)
    throw InputError(
        "--device and --validate belong to --backend vulkan: the reference uses the CPU alone");
  return {.reference = in_double() ? Precision::double_ : Precision::float_};
}

void add_device_option(CLI::App& command, std::string& device) {
  command.add_option("--device", device,
                     "Vulkan device, by index or part of its name (see facet devices)");
}

void add_backend_options(CLI::App& command, BackendChoice& choice) {
  command
      .add_option("--backend", choice.backend,
                  "What computes: the kernels on a Vulkan device, or the reference on the CPU")
      ->check(CLI::IsMember({"vulkan", "reference"}))
      ->capture_default_str();
  command
      .add_option("--precision", choice.precision, "Precision of the reference (default: float)")
      ->check(CLI::IsMember({"float", "double"}));
  add_device_option(command, choice.device);
  command.add_flag("--validate", choice.validate,
                   "Turn the Vulkan validation layers on; exit 1 on any message of theirs");
}

}  // namespace facet::cli
