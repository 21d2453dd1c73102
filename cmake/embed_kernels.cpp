// Build tool: decorates every float operation of the compiled kernels with NoContraction, the state of paths
// with Aliased, and embeds the result in a C++ file.
//     embed_kernels OUT.cpp NAME=IN.spv=OUT.spv...
// A kernel's names are KERNEL_texel and KERNEL_storage, or KERNEL_any where it sees no geometry.
// Without the decoration drivers reassociate and fuse float operations, each in its own way, and images
// differ between them. GLSL's `precise` does not reach into called functions, so it is done here, on the
// finished SPIR-V. GLSL has no word for two bindings of one memory (shaders/lib/records.glsl), which SPIR-V
// forbids undeclared.
#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "shared/bindings.h"

namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t spirv_magic = 0x07230203;
constexpr std::size_t header_words = 5;
constexpr std::uint32_t op_decorate = 71;
constexpr std::uint32_t decoration_aliased = 20;
constexpr std::uint32_t decoration_binding = 33;
constexpr std::uint32_t decoration_no_contraction = 42;

/// Whether a binding is of records that kernels write as storage and read as texels.
bool is_bound_twice(std::uint32_t binding) {
  using namespace facet::shared;
  return (binding >= BINDING_RAYS && binding <= BINDING_FILM_SQUARES) ||
         (binding >= BINDING_RAY_TEXELS && binding <= BINDING_FILM_SQUARES_TEXELS);
}

/// SPIR-V opcodes of float arithmetic, all of which NoContraction may decorate.
bool is_float_arithmetic(std::uint32_t opcode) {
  // FNegate, FAdd, FSub, FMul, FDiv, FRem, FMod; VectorTimesScalar .. OuterProduct, Dot
  constexpr std::array<std::uint32_t, 14> opcodes{127, 129, 131, 133, 136, 140, 141,
                                                  142, 143, 144, 145, 146, 147, 148};
  for (const std::uint32_t o : opcodes) {
    if (o == opcode) return true;
  }
  return false;
}

/// Instructions that come before decorations in a module's layout, debug instructions and names included.
bool precedes_decorations(std::uint32_t opcode) {
  constexpr std::array<std::uint32_t, 14> opcodes{17, 10, 11, 14, 15, 16, 331, 7, 3, 2, 4, 5, 6, 330};
  for (const std::uint32_t o : opcodes) {
    if (o == opcode) return true;
  }
  return false;
}

Words read_words(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) throw std::runtime_error("cannot read " + path);
  Words words(static_cast<std::size_t>(in.tellg()) / 4);
  in.seekg(0);
  in.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
  if (words.size() < header_words || words[0] != spirv_magic)
    throw std::runtime_error(path + " is not SPIR-V");
  return words;
}

Words decorate(const Words& in) {
  Words decorations;
  std::size_t insert_at = header_words;
  for (std::size_t i = header_words; i < in.size(); i += in[i] >> 16U) {
    const std::uint32_t opcode = in[i] & 0xffffU;
    if ((in[i] >> 16U) == 0) throw std::runtime_error("broken SPIR-V");
    if (precedes_decorations(opcode)) insert_at = i + (in[i] >> 16U);
    if (opcode == op_decorate && in[i + 2] == decoration_binding && is_bound_twice(in[i + 3])) {
      decorations.insert(decorations.end(), {(3U << 16U) | op_decorate, in[i + 1], decoration_aliased});
    }
    if (is_float_arithmetic(opcode)) {
      decorations.insert(decorations.end(),
                         {(3U << 16U) | op_decorate, in[i + 2], decoration_no_contraction});
    }
  }
  Words out(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(insert_at));
  out.insert(out.end(), decorations.begin(), decorations.end());
  out.insert(out.end(), in.begin() + static_cast<std::ptrdiff_t>(insert_at), in.end());
  return out;
}

void write_words(const std::string& path, const Words& words) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
  if (!out) throw std::runtime_error("cannot write " + path);
}

void write_array(std::ofstream& out, const std::string& name, const Words& words) {
  out << "const std::uint32_t " << name << "[] = {";
  for (std::size_t i = 0; i < words.size(); ++i) out << (i % 12 == 0 ? "\n    " : " ") << words[i] << "u,";
  out << "};\n";
}

/// What stands in kernel_code for one kernel; empty for the second of two.
std::string lookup(const std::string& name) {
  const std::string kernel = name.substr(0, name.rfind('_'));
  const std::string before = "    case Kernel::" + kernel + ":\n      return ";
  if (name.ends_with("_any")) return before + name + ";\n";
  if (!name.ends_with("_texel")) return "";
  return before + "storage ? std::span<const std::uint32_t>(" + kernel + "_storage) : " + name + ";\n";
}

void write_lookup(std::ofstream& out, const std::vector<std::string>& names) {
  out << "}  // namespace\n\n"
         "std::span<const std::uint32_t> kernel_code(Kernel kernel, GeometryFetch fetch) {\n"
         "  const bool storage = fetch == GeometryFetch::storage_buffer;\n"
         "  switch (kernel) {\n";
  for (const std::string& name : names) out << lookup(name);
  out << "  }\n  return {};\n}\n\nconst char* kernel_name(Kernel kernel) {\n  switch (kernel) {\n";
  for (const std::string& name : names) {
    const std::string kernel = name.substr(0, name.rfind('_'));
    if (!lookup(name).empty()) out << "    case Kernel::" << kernel << ": return \"" << kernel << "\";\n";
  }
  out << "  }\n  return \"\";\n}\n\n}  // namespace facet\n";
}

void run(int argc, char** argv) {
  if (argc < 3) throw std::runtime_error("usage: embed_kernels OUT.cpp NAME=IN.spv=OUT.spv...");
  std::ofstream out(argv[1]);
  out << "// Generated by cmake/embed_kernels.cpp.\n#include \"render/kernels.h\"\n\nnamespace facet "
         "{\n\nnamespace {\n\n";
  std::vector<std::string> names;
  for (int i = 2; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t first = argument.find('=');
    const std::size_t second = argument.rfind('=');
    if (first == std::string::npos || first == second) throw std::runtime_error("bad argument " + argument);
    const std::string name = argument.substr(0, first);
    const Words words = decorate(read_words(argument.substr(first + 1, second - first - 1)));
    write_words(argument.substr(second + 1), words);
    write_array(out, name, words);
    names.push_back(name);
  }
  write_lookup(out, names);
  if (!out) throw std::runtime_error(std::string("cannot write ") + argv[1]);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "embed_kernels: %s\n", e.what());
    return 1;
  }
}
