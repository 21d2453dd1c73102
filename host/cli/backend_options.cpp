#include "cli/backend_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"

namespace facet::cli {

BackendOptions BackendChoice::options() const {
  if (!is_reference()) {
    if (precision)
      throw InputError("--precision belongs to --backend reference: kernels compute in float");
    return {.device = device, .validate = validate};
  }
  if (!device.empty() || validate)
    throw InputError(
        "--device and --validate belong to --backend vulkan: the reference uses the CPU alone");
  return {.reference = precision.value_or(Precision::float_)};
}

std::string suitability(const gpu::DeviceInfo& device) {
  return device.lacks.empty() ? "has everything facet needs"
                              : fmt::format("lacks {}", fmt::join(device.lacks, ", "));
}

void add_device_option(Command& command, std::string& device) {
  command.text("--device", device,
               "Vulkan device, by index or part of its name (see facet devices)");
}

void add_backend_options(Command& command, BackendChoice& choice) {
  command.word(
      "--backend", {"vulkan", "reference"}, choice.backend,
      [&choice](const std::string& word) { choice.backend = word; },
      "What computes: the kernels on a Vulkan device, or the reference on the CPU");
  command.word("--precision", choice.precision, precision_words,
               "Precision of the reference (default: float)");
  add_device_option(command, choice.device);
  command.describe(
      "--device",
      "Vulkan device, by index or part of its name (see facet devices); all, or several "
      "with commas between, reference among them, share the samples");
  command.flag("--validate", choice.validate,
               "Turn the Vulkan validation layers on; exit 1 on any message of theirs");
}

}  // namespace facet::cli
