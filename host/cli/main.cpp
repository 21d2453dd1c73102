// facet: the command line.
#include <fcntl.h>
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <system_error>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "core/print.h"
#include "core/text.h"
#include "gpu/minimum_version.h"
#include "version.h"

namespace facet::cli {

namespace {

const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();

/// Commands of the contract that are still to come.
const std::vector<std::string> planned_commands{"tradeoff", "extremes"};

int fail(const std::string& message, ExitCode code) {
  say("facet: {}\n", message);
  return static_cast<int>(code);
}

/// The message for a command line that cannot be parsed.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error, int argc,
                          char** argv) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  const std::string first = argc > 1 ? argv[1] : "";
  if (first.starts_with('-'))
    return fmt::format("unknown option \"{}\"; \"facet --help\" lists what there is", first);
  if (first.empty() || std::find(known.begin(), known.end(), first) != known.end()) {
    return fmt::format("{}; \"facet {}--help\" lists what there is", error.what(),
                       first.empty() ? "" : first + " ");
  }
  if (std::find(planned_commands.begin(), planned_commands.end(), first) !=
      planned_commands.end()) {
    return fmt::format("the command \"{}\" is not supported yet", first);
  }
  return fmt::format("unknown command \"{}\"{}", first, did_you_mean(first, known));
}

/// A full disk behind standard output must not pass for success.
int with_output_written(int exit_code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  return fail("cannot write to standard output", ExitCode::bad_input);
}

int run(int argc, char** argv) {
  CLI::App app("facet: a path tracer in Vulkan compute shaders that proves its images right",
               "facet");
  app.set_version_flag("--version", version_text(),
                       "Version, compiler and the Vulkan version needed");
  app.require_subcommand(1);
  Action action;
  add_render_command(app, action);
  add_merge_command(app, action);
  add_compare_command(app, action);
  add_bench_command(app, action);
  add_parity_command(app, action);
  add_test_command(app, action);
  add_info_command(app, action);
  add_devices_command(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return with_output_written(app.exit(error));
    return fail(usage_message(app, error, argc, argv), ExitCode::bad_input);
  }
  return with_output_written(static_cast<int>(action()));
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
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string version_text() {
  return fmt::format("facet {} (built with {}), needs Vulkan {}.{}", FACET_VERSION, FACET_COMPILER,
                     VK_API_VERSION_MAJOR(gpu::minimum_vulkan_version),
                     VK_API_VERSION_MINOR(gpu::minimum_vulkan_version));
}

}  // namespace facet::cli

int main(int argc, char** argv) {
  facet::cli::open_standard_streams();
  // A reader that has gone is an error of the write, not the program's end.
  (void)std::signal(SIGPIPE, SIG_IGN);
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
