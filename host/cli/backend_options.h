#pragma once
// Options about who computes: the kernels on a device, or the reference on the CPU.
#include <CLI/CLI.hpp>
#include <string>

namespace facet::cli {

/// --device.
void add_device_option(CLI::App& command, std::string& device);

/// --backend, --precision, --device and --validate.
void add_backend_options(CLI::App& command, std::string& backend, std::string& precision, std::string& device,
                         bool& validate);

/// Throws InputError for options that belong to the other backend.
void check_backend_options(const std::string& backend, const std::string& precision,
                           const std::string& device, bool validate);

}  // namespace facet::cli
