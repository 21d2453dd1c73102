#pragma once
// Where drivers keep compiled kernels between runs.
#include <string>

namespace facet::gpu {

/// A sentence on where a driver (DeviceInfo::driver) keeps what it has compiled, as the environment
/// says; empty where that is not known. Mesa: https://docs.mesa3d.org/envvars.html.
[[nodiscard]] std::string describe_kernel_cache(const std::string& driver);

}  // namespace facet::gpu
