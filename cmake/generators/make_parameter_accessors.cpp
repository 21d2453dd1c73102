// Build tool: writes the GLSL macros by which shaders read the parameters of BSDFs, emitters and
// textures, from their declarations in host/scene. (Functions would be calls, which drivers take
// their time to inline.)
//     make_parameter_accessors OUT.glsl
// The parameter intIOR of roughsubstrate is roughsubstrate_int_ior(record).
#include <cctype>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <variant>

#include "render/pack/record_layout.h"
#include "scene/scene.h"
#include "shared/emitter_list.h"

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

/// Writes a macro for each parameter of one plugin.
struct AccessorWriter {
  std::ostream& out;
  std::string plugin;

  void vector(const char* name, facet::RecordPlace place, const facet::vec3& /*value*/,
              std::uint32_t /*texture*/) const {
    write(name, row(place) + ".xyz");
  }
  void number(const char* name, facet::RecordPlace place, float /*value*/,
              std::uint32_t /*texture*/) const {
    write(name, component(place));
  }
  void flag(std::uint32_t /*bit*/, bool /*is_set*/) const {}
  void write(const std::string& name, const std::string& value) const {
    out << "#define " << plugin << '_' << snake_case(name) << "(record) ((record)." << value
        << ")\n";
  }
  static std::string component(facet::RecordPlace place) {
    return row(place) + "." + "xyzw"[place.component];
  }

 private:
  static std::string row(facet::RecordPlace place) { return {"abc"[place.row]}; }
};

template <typename Type>
void write_accessors(const facet::RecordShape& shape, const char* name, std::ostream& out) {
  AccessorWriter writer{out, name};
  facet::RecordLayout<AccessorWriter> layout(shape, writer);
  const Type defaults{};
  Type::declare(defaults, layout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw std::runtime_error("usage: make_parameter_accessors OUT.glsl");
    std::ofstream out(argv[1], std::ios::binary);
    out << "// The parameters of plugins, as host/scene declares them.\n"
           "#ifndef FACET_PARAMETERS_GLSL\n#define FACET_PARAMETERS_GLSL\n\n"
           "/// Of every rough BSDF.\n";
    AccessorWriter{out, "bsdf"}.write(
        "roughness", AccessorWriter::component(facet::record_shape::bsdf.roughness.value()));
    out << '\n';
#define FACET_BSDF(name, Type, id) \
  write_accessors<facet::bsdf::Type>(facet::record_shape::bsdf, #name, out);
    FACET_BSDF_LIST(FACET_BSDF)
#undef FACET_BSDF
#define FACET_EMITTER(name, id)                                                                 \
  write_accessors<std::variant_alternative_t<id, facet::Emitter>>(facet::record_shape::emitter, \
                                                                  #name, out);
    FACET_EMITTER_LIST(FACET_EMITTER)
#undef FACET_EMITTER
#define FACET_TEXTURE(name, Type) \
  write_accessors<facet::Type>(facet::record_shape::texture, #name, out);
    FACET_TEXTURE_LIST(FACET_TEXTURE)
#undef FACET_TEXTURE
    out << "\n#endif\n";
    out.close();
    if (!out) throw std::runtime_error(std::string("cannot write ") + argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "make_parameter_accessors: " << error.what() << '\n';
    return 1;
  }
}
