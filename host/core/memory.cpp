#include "core/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <utility>

#include "core/text.h"

namespace facet {

namespace {

/// Guards the chains of activities, which other threads may look at.
std::mutex activities_mutex;

thread_local const Activity* innermost_activity = nullptr;

/// The number after a word at the start of a line of a file of the system's, times `unit`; an empty
/// word stands for the first line.
std::optional<std::uint64_t> read_figure(const std::string& file, const std::string& word,
                                         std::uint64_t unit) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line)) {
    if (!line.starts_with(word)) continue;
    const std::size_t digit = line.find_first_of("0123456789", word.size());
    if (digit == std::string::npos) return std::nullopt;
    const std::size_t end = std::min(line.find_first_not_of("0123456789", digit), line.size());
    const auto number = parse_integer(std::string_view(line).substr(digit, end - digit));
    if (!number) return std::nullopt;
    return static_cast<std::uint64_t>(*number) * unit;
  }
  return std::nullopt;
}

/// Where the files of this process's control group are, by the line of /proc/self/cgroup with that
/// mark; `root` where there is none, or where the group is seen from inside, as in a container.
std::string folder_of_group(const std::string& mark, const std::string& root, const char* file) {
  std::ifstream in("/proc/self/cgroup");
  std::string line;
  while (std::getline(in, line)) {
    const std::size_t at = line.find(mark);
    if (at == std::string::npos) continue;
    std::string folder = root + line.substr(at + mark.size());
    std::error_code unknown;
    if (std::filesystem::exists(folder + "/" + file, unknown)) return folder;
  }
  return root;
}

/// What a control group uses, less what the system keeps of files and gives up when it is asked.
std::optional<std::uint64_t> used_by_group(const std::string& usage, const std::string& statistics,
                                           const std::string& kept) {
  const auto used = read_figure(usage, "", 1);
  if (!used) return std::nullopt;
  return *used - std::min(*used, read_figure(statistics, kept, 1).value_or(0));
}

/// Narrows what is left by a limit and what is used of it, where both are known.
void narrow(std::optional<std::uint64_t>& left, std::optional<std::uint64_t> limit,
            std::optional<std::uint64_t> used) {
  if (!limit || !used) return;
  const std::uint64_t rest = *limit - std::min(*limit, *used);
  left = left ? std::min(*left, rest) : rest;
}

template <typename Resource>
std::optional<std::uint64_t> limit_of(Resource resource) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return limit.rlim_cur;
}

}  // namespace

Activity::Activity(std::string what, std::uint64_t bytes_each, std::string unit)
    : what_(std::move(what)), bytes_each_(bytes_each), unit_(std::move(unit)) {
  const std::scoped_lock lock(activities_mutex);
  outer_ = std::exchange(innermost_activity, this);
}

Activity::~Activity() {
  const std::scoped_lock lock(activities_mutex);
  innermost_activity = outer_;
}

const Activity* Activity::innermost() noexcept { return innermost_activity; }

void Activity::adopt(const Activity* activity) noexcept { innermost_activity = activity; }

std::function<std::string()> Activity::watch() {
  return [watched = &innermost_activity] {
    const std::scoped_lock lock(activities_mutex);
    return *watched != nullptr ? (*watched)->what_ : std::string();
  };
}

std::string describe_lack(std::uint64_t bytes) {
  const auto size = [](std::uint64_t b) { return with_unit_prefix(static_cast<double>(b)) + "B"; };
  const Activity* activity = Activity::innermost();
  std::string message = "out of memory";
  if (activity != nullptr) message += " while " + printable(activity->what());
  message += fmt::format(": {} more would be needed", size(bytes));
  const auto left = available_memory();
  if (!left) return message;
  message += fmt::format(", {} are left", size(*left));
  if (activity != nullptr && activity->bytes_each() > 0)
    message += fmt::format(
        "; about {} {} fit",
        with_unit_prefix(static_cast<double>(*left) / static_cast<double>(activity->bytes_each())),
        activity->unit());
  return message;
}

std::optional<std::uint64_t> memory_limit() { return limit_of(RLIMIT_DATA); }

std::optional<std::uint64_t> available_memory() {
  auto left = read_figure("/proc/meminfo", "MemAvailable:", 1024);
  // Of a container: control groups of version 2, and of version 1.
  const std::string second = folder_of_group("0::", "/sys/fs/cgroup", "memory.max");
  narrow(left, read_figure(second + "/memory.max", "", 1),
         used_by_group(second + "/memory.current", second + "/memory.stat", "inactive_file "));
  const std::string first =
      folder_of_group(":memory:", "/sys/fs/cgroup/memory", "memory.limit_in_bytes");
  narrow(left, read_figure(first + "/memory.limit_in_bytes", "", 1),
         used_by_group(first + "/memory.usage_in_bytes", first + "/memory.stat",
                       "total_inactive_file "));
  // Some software drivers' memory is shared with nobody, and yet not counted as data.
  auto data = read_figure("/proc/self/status", "VmData:", 1024);
  if (data) *data += read_figure("/proc/self/status", "RssShmem:", 1024).value_or(0);
  narrow(left, memory_limit(), data);
  narrow(left, limit_of(RLIMIT_AS), read_figure("/proc/self/status", "VmSize:", 1024));
  return left;
}

}  // namespace facet
