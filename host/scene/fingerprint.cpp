#include "scene/fingerprint.h"

#include <bit>
#include <span>

namespace facet {

namespace {

/// FNV-1a (Fowler, Noll, Vo) over 32-bit words instead of bytes, with a shift that brings high bits
/// down.
class Hash {
 public:
  void add(std::uint32_t word) {
    state_ = (state_ ^ word) * 0x100000001b3U;
    state_ ^= state_ >> 29U;
  }
  void add(std::uint64_t number) {
    add(static_cast<std::uint32_t>(number));
    add(static_cast<std::uint32_t>(number >> 32U));
  }
  void add(int number) { add(static_cast<std::uint32_t>(number)); }
  void add(float number) { add(std::bit_cast<std::uint32_t>(number)); }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  template <glm::length_t count, typename Number>
  void add(const glm::vec<count, Number>& v) {
    for (glm::length_t i = 0; i < count; ++i) add(v[i]);
  }
  void add(const dmat4& m) {
    for (glm::length_t column = 0; column < 4; ++column) add(m[column]);
  }
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    for (const char c : text) add(std::uint32_t{static_cast<unsigned char>(c)});
  }
  template <typename Item>
  void add(const std::vector<Item>& items) {
    add(std::uint64_t{items.size()});
    for (const Item& item : items) add(item);
  }
  template <typename... Types>
  void add(const std::variant<Types...>& any) {
    add(static_cast<int>(any.index()));
    std::visit([this](const auto& item) { this->add(item); }, any);
  }

  // Members are taken apart by name, so that one that is new cannot be forgotten: it does not
  // compile.
  void add(const Mesh& mesh) {
    const auto& [name, where, positions, normals, texcoords, p_indices, n_indices, t_indices, bsdf,
                 emitter] = mesh;
    add(positions);
    add(normals);
    add(texcoords);
    add(p_indices);
    add(n_indices);
    add(t_indices);
    add(bsdf);
    add(emitter);
  }
  template <typename Value>
  void add(const Textured<Value>& value) {
    add(value.texture);
    add(value.value);
  }
  template <typename Value>
  void add(const std::optional<Value>& value) {
    add(value ? 1 : 0);
    if (value) add(*value);
  }
  template <typename Value>
  requires std::is_enum_v<Value>
  void add(Value value) { add(static_cast<int>(value)); }

  /// A visitor of declared parameters.
  template <typename Value, typename Kind>
  void operator()(const char* name, const Value& value, const Kind& /*kind*/,
                  const char* /*meaning*/) {
    add(std::string_view(name));
    add(value);
  }
  /// What is in the file is hashed, wherever it lies.
  void operator()(const char* /*name*/, const std::string& /*value*/,
                  const parameter::File& /*kind*/, const char* /*meaning*/) {}
  template <typename Value>
  void derived(const char* /*name*/, const Value& /*value*/) {}
  template <typename Type>
  requires requires(const Type& value, Hash& hash) { Type::declare(value, hash); }
  void add(const Type& value) { Type::declare(value, *this); }
  void add(const Bsdf& bsdf) {
    add(bsdf_type_names.at(bsdf.index()));
    std::visit([this](const auto& parameters) { add(parameters); }, bsdf);
  }
  void add(const AreaEmitter& emitter) {
    [[maybe_unused]] const auto& [mesh, radiance, scale] = emitter;
    add(mesh);
    AreaEmitter::declare(emitter, *this);
  }
  void add(const CheckerTexture& texture) {
    [[maybe_unused]] const auto& [first, second, scale_x, scale_y, both] = texture;
    CheckerTexture::declare(texture, *this);
  }
  void add(const BitmapTexture& texture) {
    [[maybe_unused]] const auto& [width, height, texels, srgb, factor, scale_x, scale_y, colors,
                                  filename] = texture;
    add(width);
    add(height);
    add(texels);
    add(colors);
    BitmapTexture::declare(texture, *this);
  }
  void add(const EnvironmentEmitter& emitter) {
    const auto& [width, height, texels] = emitter;
    add(width);
    add(height);
    add(texels);
  }
  void add(const Camera& camera) {
    const auto& [width, height, to_world, fov, near_clip, far_clip, filter] = camera;
    add(to_world);
    add(fov);
    add(near_clip);
    add(far_clip);
    add(filter);
  }
  void add(const Integrator& integrator) {
    const auto& [type, max_depth, heuristic, selection, area, environment, candidates, position,
                 energy] = integrator;
    add(position);
    add(energy);
  }

  [[nodiscard]] std::uint64_t value() const {
    // The finaliser of G. Steele, D. Lea and C. Flood's SplitMix: the last words, too, reach every
    // bit.
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325U;
};

}  // namespace

std::uint64_t fingerprint(const Scene& scene) {
  const auto& [file, meshes, bsdfs, emitters, textures, camera, integrator, sample_count, seed,
               sampler] = scene;
  Hash hash;
  hash.add(meshes);
  hash.add(bsdfs);
  hash.add(emitters);
  hash.add(textures);
  hash.add(camera);
  hash.add(integrator);
  return hash.value();
}

}  // namespace facet
