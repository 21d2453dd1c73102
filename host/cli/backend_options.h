#pragma once
// Options about who computes: the kernels on a device, or the reference on the CPU.
#include <facet/backend.h>

#include <string>

#include "cli/command_line.h"
#include "gpu/device.h"

namespace facet::cli {

/// What the options say.
struct BackendChoice {
  std::string backend = "vulkan";
  std::optional<Precision> precision;
  std::string device;
  bool validate = false;

  [[nodiscard]] bool is_reference() const { return backend == "reference"; }
  [[nodiscard]] bool in_double() const { return precision == Precision::double_; }
  /// Throws InputError for options that belong to the other backend.
  [[nodiscard]] BackendOptions options() const;
};

/// "has everything facet needs", or "lacks ..." with what it lacks.
[[nodiscard]] std::string suitability(const gpu::DeviceInfo& device);

/// --device.
void add_device_option(Command& command, std::string& device);

/// --backend, --precision, --device and --validate.
void add_backend_options(Command& command, BackendChoice& choice);

}  // namespace facet::cli
