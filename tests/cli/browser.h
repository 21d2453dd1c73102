#pragma once
// Pages as a browser shows them.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace facet::test {

/// Standard output of a command of the shell.
inline std::string output_of(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"),
                                                             &::pclose);
  std::string text;
  char buffer[4096];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe.get())) > 0;)
    text.append(buffer, n);
  return text;
}

/// Empty where there is none.
inline std::string find_browser() {
  std::string path =
      output_of("command -v chromium || command -v chromium-browser || command -v google-chrome");
  while (path.ends_with('\n')) path.pop_back();
  return path;
}

/// The document after its scripts have run. The browser's profile goes beside the page.
inline std::string dump_dom(const std::string& browser, const std::filesystem::path& page,
                            const std::string& options = "") {
  return output_of("timeout 100 '" + browser +
                   "' --headless --no-sandbox --disable-gpu --window-size=1300,900 " + options +
                   " --user-data-dir='" + (page.parent_path() / "profile").string() +
                   "' --dump-dom 'file://" + page.string() + "' 2>/dev/null");
}

}  // namespace facet::test
