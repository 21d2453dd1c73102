#pragma once
// Runs the program as a user would, in a folder of its own.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "support/input.h"

namespace facet::test {

struct Result {
  int code = -1;    ///< exit code; 1000 + the signal's number where one ended it
  std::string out;  ///< standard output
  std::string err;  ///< standard error
};

/// A square floor, and a light of half its side above it that looks down; 16x16 pixels, 4 samples.
class CliTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("floor.obj", "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 1 4 3 2\n");
    folder_.write("light.obj",
                  "v -0.5 1 -0.5\nv 0.5 1 -0.5\nv 0.5 1 0.5\nv -0.5 1 0.5\nf 1 2 3 4\n");
    write_scene("scene.xml", floor() + light());
  }

  static std::string floor() { return mesh("floor.obj", "<bsdf type=\"diffuse\"/>"); }
  static std::string light() { return mesh("light.obj", "<emitter type=\"area\"/>"); }
  static std::string mesh(const std::string& file, const std::string& children) {
    return "<mesh type=\"obj\"><string name=\"filename\" value=\"" + file + "\"/>" + children +
           "</mesh>\n";
  }

  /// On the floor, in one line; `children` are its other ones, as its filter.
  static std::string camera(const std::string& children = {}) {
    return R"(<camera type="perspective"><integer name="width" value="16"/>)"
           R"(<integer name="height" value="16"/><transform name="toWorld">)"
           R"(<lookat origin="0.1 0.8 -4" target="0 0.4 0" up="0 1 0"/></transform>)" +
           children + "</camera>";
  }

  /// A scene with camera, sampler and integrator on lines 2 to 4; the content begins on line 5.
  std::filesystem::path write_scene(const std::string& name, const std::string& content) const {
    return folder_.write(name, "<scene>\n" + camera() + R"(
<sampler type="independent"><integer name="sampleCount" value="4"/></sampler>
<integrator type="direct_mis"/>
)" + content + "</scene>\n");
  }

  /// Starts the program in the folder, its output going to files there; `variables` join the
  /// environment.
  pid_t start(std::vector<std::string> arguments,
              const std::vector<std::string>& variables = {}) const {
    arguments.insert(arguments.begin(), FACET_PROGRAM);
    return start_command(std::move(arguments), variables);
  }

  /// The same for any program, by name or path.
  pid_t start_command(std::vector<std::string> words,
                      const std::vector<std::string>& variables = {}) const {
    const std::filesystem::path out = outputs_.file("out");
    const std::filesystem::path err = outputs_.file("err");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), flags, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), flags, 0600);
    posix_spawn_file_actions_addchdir_np(&actions, folder_.path().c_str());
    // The first of two equal names counts.
    std::vector<std::string> environment = variables;
    for (char** variable = environ; *variable != nullptr; ++variable)
      environment.emplace_back(*variable);
    pid_t child = -1;
    const int error = ::posix_spawnp(&child, words[0].c_str(), &actions, nullptr,
                                     pointers(words).data(), pointers(environment).data());
    posix_spawn_file_actions_destroy(&actions);
    EXPECT_EQ(error, 0) << "cannot start " << words[0];
    return child;
  }

  /// Waits for the program's end: for an hour, so that no load on the machine looks like a program
  /// that hangs.
  Result finish(pid_t child) const {
    Result result;
    int status = 0;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::hours(1);
    while (::waitpid(child, &status, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() > deadline) {
        ADD_FAILURE() << "the program hangs";
        ::kill(child, SIGKILL);
        ::waitpid(child, &status, 0);
        break;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    result.out = outputs_.read("out");
    result.err = outputs_.read("err");
    return result;
  }

  Result run(const std::vector<std::string>& arguments,
             const std::vector<std::string>& variables = {}) const {
    return finish(start(arguments, variables));
  }

  /// Expects the exit code, an empty standard output, and every one of the words on standard error.
  void expect_failure(const std::vector<std::string>& arguments, int code,
                      std::initializer_list<const char*> words) const {
    const Result result = run(arguments);
    SCOPED_TRACE(::testing::PrintToString(arguments));
    EXPECT_EQ(result.code, code) << result.err;
    EXPECT_EQ(result.out, "");
    expect_words(result.err, words);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1)
        << "one line says it: " << result.err;
  }

  static void expect_words(const std::string& text, std::initializer_list<const char*> words) {
    for (const char* word : words)
      EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
  }

  TemporaryFolder folder_;

 private:
  static std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> list;
    list.reserve(words.size() + 1);
    for (std::string& word : words) list.push_back(word.data());
    list.push_back(nullptr);
    return list;
  }

  TemporaryFolder outputs_;
};

}  // namespace facet::test
