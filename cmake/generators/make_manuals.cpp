// Build tool: turns the comments at the heads of plugins into strings.
//     make_manuals OUT.cpp FILE...
// A manual is a comment that begins a line with "/* NAME, NAME: what it is.", its first sentence
// being the plugin in one line. The plugin's kind is the file's folder, or in host/scene the file
// itself. After the first paragraph the table of the plugin's parameters will stand
// (host/scene/manuals.h).
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Manual {
  std::string kind;
  std::vector<std::string> names;
  std::string summary;
  std::string opening;  ///< first paragraph
  std::string details;
};

std::string read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw std::runtime_error("cannot read " + file.string());
  return text.str();
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

std::string kind_of(const std::filesystem::path& file) {
  std::string folder = file.parent_path().filename().string();
  if (folder != "scene") return folder;
  const std::string stem = file.stem().string();
  return stem == "filter" ? "rfilter" : stem;
}

/// The comment's lines without their indentation.
std::string tidied(const std::string& comment) {
  std::istringstream in(comment);
  std::string text;
  for (std::string line; std::getline(in, line);) {
    line.erase(0, std::min(line.find_first_not_of(' '), line.size()));
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

std::string first_sentence(const std::string& text) {
  std::string sentence = text.substr(0, std::min(text.find("\n\n"), text.size()));
  std::replace(sentence.begin(), sentence.end(), '\n', ' ');
  return sentence.substr(0, std::min(sentence.find(". "), sentence.find_last_not_of(".;,") + 1));
}

std::vector<Manual> manuals_in(const std::filesystem::path& file) {
  static const std::regex start(R"((^|\n)/\* ([a-z0-9_]+(,\s+[a-z0-9_]+)*):\s+)");
  static const std::regex name(R"([a-z0-9_]+)");
  const std::string source = read(file);
  std::vector<Manual> manuals;
  for (std::sregex_iterator i(source.begin(), source.end(), start); i != std::sregex_iterator();
       ++i) {
    const auto begin = static_cast<std::size_t>(i->position() + i->length());
    const std::string text = tidied(source.substr(begin, source.find("*/", begin) - begin));
    const std::string names = i->str(2);
    const std::size_t end = std::min(text.find("\n\n"), text.size());
    Manual manual{kind_of(file), {}, first_sentence(text), text.substr(0, end) + "\n", ""};
    if (end < text.size()) manual.details = text.substr(end + 2) + "\n";
    for (std::sregex_iterator n(names.begin(), names.end(), name); n != std::sregex_iterator(); ++n)
      manual.names.push_back(n->str());
    manuals.push_back(manual);
  }
  return manuals;
}

std::string joined(const std::vector<std::string>& names, const std::string& separator) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : separator) + name;
  return text;
}

std::string as_source(const std::vector<Manual>& manuals) {
  std::string text =
      "#include \"scene/manuals.h\"\n\n#include <array>\n\nnamespace facet {\n\nnamespace {\n\n";
  text += "constexpr std::array<Manual, " + std::to_string(manuals.size()) + "> list{{\n";
  for (const Manual& m : manuals) {
    text += "    {\"" + m.kind + "\", \" " + joined(m.names, " ") + " \", R\"~~~(" + m.summary +
            ")~~~\", R\"~~~(" + m.opening + ")~~~\", R\"~~~(" + m.details + ")~~~\"},\n";
  }
  return text +
         "}};\n\n}  // namespace\n\nstd::span<const Manual> manuals() { return list; }\n\n}  // "
         "namespace "
         "facet\n";
}

void make(const std::vector<std::string>& arguments) {
  if (arguments.size() < 2) throw std::runtime_error("usage: make_manuals OUT.cpp FILE...");
  std::vector<Manual> manuals;
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    for (Manual& manual : manuals_in(arguments[i])) manuals.push_back(std::move(manual));
  }
  std::stable_sort(manuals.begin(), manuals.end(), [](const Manual& a, const Manual& b) {
    return std::pair(a.kind, a.names.front()) < std::pair(b.kind, b.names.front());
  });
  write(arguments[0], as_source(manuals));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    make({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "make_manuals: " << error.what() << '\n';
    return 1;
  }
}
