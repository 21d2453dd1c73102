#include "gpu/kernel_cache.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

namespace facet::gpu {

namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool is_true(const std::string& value) { return value == "1" || value == "true" || value == "yes"; }

/// The folder below which Mesa makes its own; empty without a home.
std::filesystem::path cache_root() {
  if (const std::string folder = variable("MESA_SHADER_CACHE_DIR"); !folder.empty()) return folder;
  if (const std::string folder = variable("XDG_CACHE_HOME"); !folder.empty()) return folder;
  if (const std::string home = variable("HOME"); !home.empty())
    return std::filesystem::path(home) / ".cache";
  return {};
}

}  // namespace

std::string describe_kernel_cache(const std::string& driver) {
  if (driver.find("Mesa") == std::string::npos) return "";
  if (is_true(variable("MESA_SHADER_CACHE_DISABLE")))
    return "keeps no compiled kernels (MESA_SHADER_CACHE_DISABLE)";
  const std::filesystem::path root = cache_root();
  if (root.empty())
    return "keeps no compiled kernels (neither HOME nor XDG_CACHE_HOME nor MESA_SHADER_CACHE_DIR "
           "is set)";
  // One file a kernel, or, since Mesa 24, a database.
  std::string folders;
  for (const char* name : {"mesa_shader_cache", "mesa_shader_cache_db"}) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(root / name, ignored)) continue;
    folders += (folders.empty() ? "" : " or ") + (root / name).string();
  }
  if (folders.empty()) return fmt::format("will keep compiled kernels below {}", root.string());
  return fmt::format("keeps compiled kernels in {}", folders);
}

}  // namespace facet::gpu
