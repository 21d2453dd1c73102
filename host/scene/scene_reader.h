#pragma once
// From one <scene> element to a Scene.
#include "scene/mesh/obj.h"
#include "scene/reader.h"
#include "scene/scene.h"
#include "scene/xml/property_reader.h"

namespace facet {

/// Gathers a scene's parts; for one scene. Every member throws InputError, with file and line, for
/// whatever is wrong. Keeps references to its arguments.
class SceneReader {
 public:
  SceneReader(const XmlDocument& xml, Diagnostics& diagnostics, const Overridden& overridden = {})
      : xml_(xml), diagnostics_(diagnostics), overridden_(overridden) {
    scene_.file = xml.path();
  }

  /// All of a <scene>.
  [[nodiscard]] Scene read(const pugi::xml_node& node) &&;
  /// The same, with meshes that are in memory: the k-th <mesh type="memory"> stands for the k-th of
  /// them, and has a BSDF.
  [[nodiscard]] Scene read(const pugi::xml_node& node, std::vector<Mesh> memory_meshes) &&;
  /// A <bsdf>; its textures join those of the scene.
  [[nodiscard]] Bsdf read_bsdf(const pugi::xml_node& node);
  [[nodiscard]] bool has_textures() const { return !scene_.textures.empty(); }

 private:
  void read_camera(PropertyReader& scene);
  [[nodiscard]] Filter read_filter(const pugi::xml_node& node);
  void read_sampler(PropertyReader& scene);
  void read_integrator(PropertyReader& scene);
  /// An error, but a warning where an option takes its place.
  void forgive_unknown_type(const PropertyReader& p, const std::string& tag, bool overridden);
  void read_mesh(const pugi::xml_node& node);
  /// A mesh's parts and the BSDF of each.
  struct Surfaces {
    std::vector<Mesh> meshes;
    std::vector<Bsdf> bsdfs;
  };
  [[nodiscard]] Surfaces read_surfaces(PropertyReader& p);
  /// Index of a material's map among the textures; none, with a warning, where it cannot be read.
  std::uint32_t read_material_texture(const std::filesystem::path& map, const std::string& material,
                                      const SourceLocation& where);
  /// What the materials of an OBJ file in that folder say of each of its parts.
  [[nodiscard]] std::vector<Bsdf> read_materials(const ObjParts& parts,
                                                 const std::filesystem::path& folder,
                                                 const SourceLocation& where);
  [[nodiscard]] AreaEmitter read_mesh_emitter(const pugi::xml_node& node);
  void read_emitter(const pugi::xml_node& node);
  /// Returns the texture's index.
  std::uint32_t add_texture(const pugi::xml_node& node, float most);
  /// An object tag with a type.
  [[nodiscard]] PropertyReader open(const pugi::xml_node& node) const;
  /// The same, whose parameters may be textures.
  [[nodiscard]] PropertyReader open_textured(const pugi::xml_node& node);

  const XmlDocument& xml_;
  Diagnostics& diagnostics_;
  Overridden overridden_;
  Scene scene_;
  std::vector<Mesh> memory_meshes_;
  std::size_t used_memory_meshes_ = 0;
};

}  // namespace facet
