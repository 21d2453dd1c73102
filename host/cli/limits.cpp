#include "cli/limits.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>

#include "cli/commands.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/print.h"
#include "core/sanitized.h"
#include "core/text.h"

namespace facet::cli {

namespace {

/// "2G", "1.5 GB" or "2000000000". Throws InputError for anything else, and for less than a MB.
std::uint64_t parse_bytes(std::string text) {
  const std::string given = text;
  if (text.ends_with('B')) text.pop_back();
  double unit = 1;
  for (const auto& [letter, size] : {std::pair{'k', 1e3}, {'K', 1e3}, {'M', 1e6}, {'G', 1e9}}) {
    if (!text.ends_with(letter)) continue;
    unit = size;
    text.pop_back();
    break;
  }
  const auto number = parse_real(trimmed(text));
  const double bytes = number.value_or(0) * unit;
  if (!(bytes >= 1e6 && bytes <= 1e18))
    throw InputError(fmt::format(
        "--limit-memory: \"{}\" is not a size of at least 1M, as 2000000000, 2000M or 2G", given));
  return static_cast<std::uint64_t>(bytes);
}

void limit_memory(const std::string& text) {
  const std::uint64_t bytes = parse_bytes(text);
  if (is_sanitized) throw InputError("--limit-memory: a build with AddressSanitizer has no limit");
  rlimit limit{};
  (void)::getrlimit(RLIMIT_DATA, &limit);
  if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur <= bytes) return;
  limit.rlim_cur = bytes;
  if (::setrlimit(RLIMIT_DATA, &limit) != 0)
    throw InputError(fmt::format("--limit-memory {}: {}", text, std::strerror(errno)));
}

/// Whatever is in the way, as a loop in a library, the program ends.
void limit_time(double seconds) {
  std::thread([seconds, activity = Activity::watch()] {
    const double left = seconds - seconds_since_start();
    if (left > 0) std::this_thread::sleep_for(std::chrono::duration<double>(left));
    // Nor may a reader of the message be who does not read.
    (void)std::signal(SIGALRM, SIG_DFL);
    (void)::alarm(1);
    const std::string what = activity();
    say("facet: --limit-time {:g}: the time is over{}; what was not written by now is not\n",
        seconds, what.empty() ? "" : " while " + what);
    AtomicFile::remove_unfinished();
    ::_exit(static_cast<int>(ExitCode::bad_input));
  }).detach();
}

}  // namespace

void add_limit_options(Command& command, Limits& limits) {
  command.group("Limits, for services that render strangers' scenes");
  command.text("--limit-memory", limits.memory,
               "Refuse to take more memory of the host than this many bytes, as 2G; what lacks it "
               "is named");
  constexpr double least = 0.001;
  constexpr double most = 1e9;
  command.number("--limit-time", limits.time, least, most,
                 "End with an error, and without an image, if not done this many seconds after the "
                 "start");
}

void set_limits(const Limits& limits) {
  if (limits.memory) limit_memory(*limits.memory);
  if (limits.time) limit_time(*limits.time);
}

}  // namespace facet::cli
