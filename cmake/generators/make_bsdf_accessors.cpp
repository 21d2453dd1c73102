// Build tool: writes the GLSL macros by which shaders read the parameters of BSDFs, from the
// declarations in host/scene/bsdf. (Functions would be calls, which drivers take their time to
// inline.)
//     make_bsdf_accessors OUT.glsl
// The parameter intIOR of roughsubstrate is roughsubstrate_int_ior(b).
#include <cctype>
#include <fstream>
#include <iostream>

#include "render/pack/bsdf_record.h"

namespace {

/// intIOR: int_ior.
std::string snake_case(const std::string& name) {
  std::string text;
  bool after_small = false;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (after_small && std::isupper(letter) != 0) text += '_';
    text += static_cast<char>(std::tolower(letter));
    after_small = std::islower(letter) != 0;
  }
  return text;
}

/// Writes a macro for each parameter of one BSDF.
struct AccessorWriter {
  std::ostream& out;
  std::string bsdf;

  void color(const char* name, facet::RecordPlace place, const facet::Color& /*value*/,
             std::uint32_t /*texture*/) const {
    write(name, row(place) + ".rgb");
  }
  void number(const char* name, facet::RecordPlace place, float /*value*/,
              std::uint32_t /*texture*/) const {
    write(name, row(place) + "." + "xyzw"[place.component]);
  }
  void flag(std::uint32_t /*bit*/, bool /*is_set*/) const {}

 private:
  static std::string row(facet::RecordPlace place) { return {"abc"[place.row]}; }
  void write(const char* name, const std::string& value) const {
    out << "#define " << bsdf << '_' << snake_case(name) << "(b) ((b)." << value << ")\n";
  }
};

template <typename Type>
void write_accessors(const char* name, std::ostream& out) {
  AccessorWriter writer{out, name};
  facet::RecordLayout<AccessorWriter> layout(writer);
  const Type defaults{};
  Type::declare(defaults, layout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw std::runtime_error("usage: make_bsdf_accessors OUT.glsl");
    std::ofstream out(argv[1], std::ios::binary);
    out << "// The parameters of BSDFs, as host/scene/bsdf declares them.\n"
           "#ifndef FACET_BSDF_PARAMETERS_GLSL\n#define FACET_BSDF_PARAMETERS_GLSL\n\n"
           "/// Of every rough BSDF.\n#define bsdf_roughness(b) ((b).a.w)\n\n";
#define FACET_ACCESSORS(name, Type, id) write_accessors<facet::bsdf::Type>(#name, out);
    FACET_BSDF_LIST(FACET_ACCESSORS)
#undef FACET_ACCESSORS
    out << "\n#endif\n";
    out.close();
    if (!out) throw std::runtime_error(std::string("cannot write ") + argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "make_bsdf_accessors: " << error.what() << '\n';
    return 1;
  }
}
