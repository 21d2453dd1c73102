// Build tool: writes docs/reference/plugins.md, the manuals of all plugins.
//     make_plugins_page OUT.md PICTURES_FOLDER
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>
#include <vector>

#include "core/text.h"
#include "scene/manuals.h"

namespace {

/// Characters that markdown takes for its own, outside of `code`.
std::string escaped(const std::string& text) {
  std::string result;
  bool is_code = false;
  for (const char c : text) {
    is_code = is_code != (c == '`');
    if (!is_code && (c == '*' || c == '<')) result += '\\';
    result += c;
  }
  return result;
}

std::string section(const facet::Manual& manual, const std::filesystem::path& pictures) {
  const std::string folder = pictures.filename().string();
  std::string names;
  std::string images;
  for (const std::string_view part : facet::split_list(manual.names)) {
    const std::string name(part);
    names += (names.empty() ? "" : ", ") + name;
    if (std::filesystem::exists(pictures / (name + ".png")))
      images.append("![").append(name).append("](").append(folder).append("/").append(name).append(
          ".png)\n\n");
  }
  std::string text = escaped(full_text(manual));
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return "\n### " + names + "\n\n" + images + text;
}

std::string page(const std::filesystem::path& pictures) {
  std::map<std::string_view, std::string> kinds;
  for (const facet::Manual& m : facet::manuals()) kinds[m.kind] += section(m, pictures);
  std::string text =
      "# Plugins of the scene language\n\n"
      "This page is made from the comments at the heads of the plugins' files and the\n"
      "declarations of their parameters: change those, then `ninja plugins_page`. `facet info\n"
      "--plugins NAME` prints the same.\n";
  for (const auto& [kind, sections] : kinds)
    text.append("\n## ").append(kind).append("\n").append(sections);
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 3) throw std::runtime_error("usage: make_plugins_page OUT.md PICTURES_FOLDER");
    std::ofstream out(argv[1], std::ios::binary);
    out << page(argv[2]);
    out.close();
    if (!out) throw std::runtime_error(std::string("cannot write ") + argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "make_plugins_page: " << error.what() << '\n';
    return 1;
  }
}
