// Build tool: writes the GLSL functions that read records from texels of four words, from the
// shared list of bindings and the structs of shaders/shared/records.h.
//     make_record_reads OUT.glsl RECORDS.h
// Records are laid out by std430: members of one word, or vectors of four at multiples of four
// words.
#include <fstream>
#include <iostream>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "shared/binding_list.h"

namespace {

using Types = std::vector<std::string>;  // of a record's members

std::string read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw std::runtime_error("cannot read " + path);
  return text.str();
}

/// Members of every struct without arrays.
std::map<std::string, Types> parse_structs(const std::string& header) {
  static const std::regex comment(R"(//[^\n]*)");
  static const std::regex definition(R"(struct\s+(\w+)\s*\{([^}]*)\})");
  static const std::regex member(R"((\w+)\s+\w+\s*;)");
  const std::string text = std::regex_replace(header, comment, "");
  std::map<std::string, Types> structs;
  for (std::sregex_iterator s(text.begin(), text.end(), definition); s != std::sregex_iterator();
       ++s) {
    const std::string body = s->str(2);
    if (body.find('[') != std::string::npos) continue;
    Types& types = structs[s->str(1)];
    for (std::sregex_iterator m(body.begin(), body.end(), member); m != std::sregex_iterator(); ++m)
      types.push_back(m->str(1));
  }
  return structs;
}

/// The bits `words` as a value of a type.
std::string value_of(const std::string& type, const std::string& words) {
  if (type == "uint" || type == "uvec4") return words;
  if (type == "float" || type == "vec4") return "uintBitsToFloat(" + words + ")";
  throw std::runtime_error("no way to read a " + type);
}

/// Reads the members of a record, texel by texel.
std::string read_of_record(const std::string& name, const std::string& record, const Types& types) {
  std::size_t word = 0;
  std::string arguments;
  for (const std::string& type : types) {
    const bool is_vector = type == "vec4" || type == "uvec4";
    if (is_vector && word % 4 != 0) throw std::runtime_error(record + ": a vector is not aligned");
    const std::string texel = "t" + std::to_string(word / 4);
    arguments += (arguments.empty() ? "" : ", ") +
                 value_of(type, is_vector ? texel : texel + "." + "xyzw"[word % 4]);
    word += is_vector ? 4 : 1;
  }
  if (word % 4 != 0) throw std::runtime_error(record + " is not a whole number of texels");
  const std::string first = word == 4 ? "i" : std::to_string(word / 4) + "u * i";
  std::string text = record + " fetch_" + name + "(uint i) {\n";
  for (std::size_t t = 0; t < word / 4; ++t) {
    const std::string n = std::to_string(t);
    text.append("  uvec4 t").append(n).append(" = ").append(name).append("_texel(").append(first);
    text.append(t == 0 ? "" : " + " + n + "u").append(");\n");
  }
  return text + "  return " + record + "(" + arguments + ");\n}\n";
}

/// A function that reads what binding `name` holds.
std::string read_from_texels(const std::string& name, const std::string& record,
                             const std::map<std::string, Types>& structs) {
  const std::string head = record + " fetch_" + name + "(uint i) { return ";
  const std::string texel = name + "_texel(i";
  if (record == "vec4" || record == "uvec4") return head + value_of(record, texel + ")") + "; }\n";
  if (record == "uint" || record == "float")
    return head + value_of(record, "word_of(" + texel + " / 4u), i % 4u)") + "; }\n";
  if (record == "vec2") {
    return record + " fetch_" + name + "(uint i) {\n  vec4 two = uintBitsToFloat(" + texel +
           " / 2u));\n  return i % 2u == 0u ? two.xy : two.zw;\n}\n";
  }
  const auto found = structs.find(record);
  // Arrays of texels are read as such.
  return found == structs.end() ? "" : read_of_record(name, record, found->second);
}

void write(const std::string& path, const std::map<std::string, Types>& structs) {
  std::string from_texels;
  std::string from_storage;
  const auto add = [&](const std::string& kind, const std::string& names, const std::string& name,
                       const std::string& record) {
    if (kind != "scene" && kind != "state") return;
    const std::string read = read_from_texels(name, record, structs);
    if (kind == "scene") {
      from_texels += read;
      return;
    }
    from_storage.append("#ifdef FACET_NO_TEXEL_BUFFERS\n").append(record).append(" fetch_");
    from_storage.append(name).append("(uint i) { return ").append(names).append("[i]; }\n#else\n");
    from_storage.append(read).append("#endif\n");
  };
#define FACET_ADD(number, kind, names, name, Record) add(#kind, #names, #name, #Record);
  FACET_BINDING_LIST(FACET_ADD)
#undef FACET_ADD
  std::ofstream out(path, std::ios::binary);
  out << "// Reads of the records of shared/binding_list.h, for lib/records.glsl.\n"
      << from_texels << from_storage;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 3) throw std::runtime_error("usage: make_record_reads OUT.glsl RECORDS.h");
    write(argv[1], parse_structs(read(argv[2])));
  } catch (const std::exception& error) {
    std::cerr << "make_record_reads: " << error.what() << '\n';
    return 1;
  }
}
