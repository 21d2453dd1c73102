// facet: the command line.
#include <fcntl.h>
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <system_error>

#include "cli/allocation.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "core/memory.h"
#include "core/print.h"
#include "core/text.h"
#include "gpu/device.h"
#include "version.h"

namespace facet::cli {

namespace {

const std::chrono::steady_clock::time_point process_start = std::chrono::steady_clock::now();

/// "facet 0.1.0 (...), needs Vulkan 1.1"
std::string version_text() {
  return fmt::format("facet {} (built with {}), needs Vulkan {}", FACET_VERSION, FACET_COMPILER,
                     gpu::minimum_vulkan_version);
}

int fail(const std::string& message, ExitCode code) {
  say("facet: {}\n", message);
  return static_cast<int>(code);
}

/// A full disk behind standard output must not pass for success.
int with_output_written(int exit_code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  return fail("cannot write to standard output", ExitCode::bad_input);
}

int run(int argc, char** argv) {
  const Activity activity("starting");
  CommandLine line("a path tracer in Vulkan compute shaders that proves its images right",
                   version_text());
  add_render_command(line);
  add_merge_command(line);
  add_farm_plan_command(line);
  add_compare_command(line);
  add_bench_command(line);
  add_tradeoff_command(line);
  add_parity_command(line);
  add_test_command(line);
  add_extremes_command(line);
  add_info_command(line);
  add_devices_command(line);
  add_selftest_command(line);
  add_manual_command(line);
  return with_output_written(static_cast<int>(line.run(argc, argv)));
}

/// Descriptors 0 to 2 that whoever started the program has closed would go to the next files that
/// are opened, and messages into these.
void open_standard_streams() {
  for (const int descriptor : {0, 1, 2}) {
    if (::fcntl(descriptor, F_GETFD) < 0)
      (void)::open("/dev/null", descriptor == 0 ? O_RDONLY : O_WRONLY);
  }
}

}  // namespace

double seconds_since_start() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - process_start).count();
}

}  // namespace facet::cli

int main(int argc, char** argv) {
  facet::cli::tell_of_refused_allocations();
  facet::cli::open_standard_streams();
  // A reader that has gone is an error of the write, not the program's end.
  (void)std::signal(SIGPIPE, SIG_IGN);
  // So is a file that has become as large as the user's limit lets it.
  (void)std::signal(SIGXFSZ, SIG_IGN);
  facet::cli::tell_of_crashes();
  try {
    return facet::cli::run(argc, argv);
  } catch (const facet::Error& error) {
    return facet::cli::fail(error.what(), facet::cli::exit_code_of(error.kind()));
  } catch (const std::bad_alloc&) {
    return facet::cli::fail("out of memory", facet::cli::ExitCode::bad_input);
  } catch (const std::exception& error) {
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    if (system != nullptr && system->code() == std::errc::resource_unavailable_try_again)
      return facet::cli::fail(
          "cannot start another thread: a limit of processes or of memory is reached",
          facet::cli::ExitCode::device_failed);
    return facet::cli::fail(error.what(), facet::cli::ExitCode::device_failed);
  }
}
