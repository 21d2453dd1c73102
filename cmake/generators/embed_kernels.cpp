// Build tool: decorates every float operation of the compiled kernels with NoContraction, the state
// of paths with Aliased, simplifies them, inlines functions, and embeds the result in a C++ file.
//     embed_kernels OUT.cpp NAME=IN.spv=OUT.spv...
// A kernel's names are KERNEL_texel and KERNEL_storage, or KERNEL_any where it sees no geometry.
// Without the decoration drivers reassociate and fuse float operations, each in its own way, and
// images differ between them. GLSL's `precise` does not reach into called functions, so it is done
// here, on the finished SPIR-V. GLSL has no word for two bindings of one memory
// (shaders/shared/binding_list.h), which SPIR-V forbids undeclared.
#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "gpu/spirv_module.h"
#include "inline_functions.h"
#include "shared/bindings.h"
#include "spirv_passes.h"

namespace {

using Words = std::vector<std::uint32_t>;

enum class Kind { scene, uniform, state, storage };

/// Whether a binding is of records that kernels write as storage and read as texels.
bool is_bound_twice(std::uint32_t binding) {
  using enum Kind;
  constexpr std::array kinds{
#define FACET_KIND(number, kind, names, name, Record) kind,
      FACET_BINDING_LIST(FACET_KIND)
#undef FACET_KIND
  };
  const std::uint32_t number = binding % facet::shared::BINDING_TEXELS;
  return number < kinds.size() && kinds.at(number) == state;
}

/// Float arithmetic, all of which NoContraction may decorate.
bool is_float_arithmetic(spv::Op opcode) {
  switch (opcode) {
    case spv::OpFNegate:
    case spv::OpFAdd:
    case spv::OpFSub:
    case spv::OpFMul:
    case spv::OpFDiv:
    case spv::OpFRem:
    case spv::OpFMod:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
    case spv::OpVectorTimesMatrix:
    case spv::OpMatrixTimesVector:
    case spv::OpMatrixTimesMatrix:
    case spv::OpOuterProduct:
    case spv::OpDot:
      return true;
    default:
      return false;
  }
}

/// Instructions that come before decorations in a module's layout, debug instructions and names
/// included.
bool precedes_decorations(spv::Op opcode) {
  switch (opcode) {
    case spv::OpCapability:
    case spv::OpExtension:
    case spv::OpExtInstImport:
    case spv::OpMemoryModel:
    case spv::OpEntryPoint:
    case spv::OpExecutionMode:
    case spv::OpExecutionModeId:
    case spv::OpString:
    case spv::OpSource:
    case spv::OpSourceContinued:
    case spv::OpSourceExtension:
    case spv::OpName:
    case spv::OpMemberName:
    case spv::OpModuleProcessed:
      return true;
    default:
      return false;
  }
}

Words read_words(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) throw std::runtime_error("cannot read " + path);
  Words words(static_cast<std::size_t>(in.tellg()) / 4);
  in.seekg(0);
  in.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
  return words;
}

Words decorate(const Words& in) {
  const auto instructions = facet::gpu::spirv::parse(in);
  if (instructions.empty()) throw std::runtime_error("not SPIR-V");
  Words decorations;
  const auto add = [&](std::uint32_t id, spv::Decoration decoration) {
    decorations.insert(decorations.end(), {facet::gpu::spirv::first_word(spv::OpDecorate, 3), id,
                                           static_cast<std::uint32_t>(decoration)});
  };
  std::size_t insert_at = 0;
  std::size_t end = facet::gpu::spirv::header_words;
  for (const auto& i : instructions) {
    end += i.words.size();
    if (precedes_decorations(i.opcode())) insert_at = end;
    if (i.opcode() == spv::OpDecorate && i.words[2] == spv::DecorationBinding &&
        is_bound_twice(i.words[3]))
      add(i.words[1], spv::DecorationAliased);
    if (is_float_arithmetic(i.opcode())) add(i.result(), spv::DecorationNoContraction);
  }
  Words out(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(insert_at));
  out.insert(out.end(), decorations.begin(), decorations.end());
  out.insert(out.end(), in.begin() + static_cast<std::ptrdiff_t>(insert_at), in.end());
  return out;
}

/// Turns variables into values and equal values into one, as far as can be done before
/// specialization, which follows values alone. What is done here need not be done at each start.
Words simplify(const Words& in) {
  return facet::run_passes(in, "cannot be simplified", [](spvtools::Optimizer& optimizer) {
    optimizer.RegisterPass(spvtools::CreateScalarReplacementPass(100))
        .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
        .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
        .RegisterPass(spvtools::CreateLocalMultiStoreElimPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass())
        .RegisterPass(spvtools::CreateRedundancyEliminationPass())
        .RegisterPass(spvtools::CreateBlockMergePass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
  });
}

void write_words(const std::string& path, const Words& words) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(words.data()),
            static_cast<std::streamsize>(words.size() * 4));
  if (!out) throw std::runtime_error("cannot write " + path);
}

void write_array(std::ofstream& out, const std::string& name, const Words& words) {
  out << "const std::uint32_t " << name << "[] = {";
  for (std::size_t i = 0; i < words.size(); ++i)
    out << (i % 12 == 0 ? "\n    " : " ") << words[i] << "u,";
  out << "};\n";
}

/// What stands in kernel_code for one kernel; empty for the second of two.
std::string lookup(const std::string& name) {
  const std::string kernel = name.substr(0, name.rfind('_'));
  const std::string before = "    case Kernel::" + kernel + ":\n      return ";
  if (name.ends_with("_any")) return before + name + ";\n";
  if (!name.ends_with("_texel")) return "";
  return before + "storage ? std::span<const std::uint32_t>(" + kernel + "_storage) : " + name +
         ";\n";
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
    if (!lookup(name).empty())
      out << "    case Kernel::" << kernel << ": return \"" << kernel << "\";\n";
  }
  out << "  }\n  return \"\";\n}\n\n}  // namespace facet\n";
}

void run(int argc, char** argv) {
  if (argc < 3) throw std::runtime_error("usage: embed_kernels OUT.cpp NAME=IN.spv=OUT.spv...");
  std::ofstream out(argv[1]);
  out << "// Generated by cmake/generators/embed_kernels.cpp.\n#include "
         "\"render/kernels.h\"\n\nnamespace "
         "facet "
         "{\n\nnamespace {\n\n";
  std::vector<std::string> names;
  for (int i = 2; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t first = argument.find('=');
    const std::size_t second = argument.rfind('=');
    if (first == std::string::npos || first == second)
      throw std::runtime_error("bad argument " + argument);
    const std::string name = argument.substr(0, first);
    const Words decorated = decorate(read_words(argument.substr(first + 1, second - first - 1)));
    // Simplified before, since length decides what is inlined, and after, since parameters of what
    // is inlined are variables.
    const Words words = simplify(facet::inline_functions(simplify(decorated)));
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
