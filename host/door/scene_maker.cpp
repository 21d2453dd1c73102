#include <facet/scene.h>
#include <fmt/format.h>

#include <cmath>
#include <pugixml.hpp>
#include <sstream>

#include "door/warnings.h"
#include "scene/scene_reader.h"

namespace facet {

namespace {

constexpr const char* memory_place = "(scene in memory)";

/// As doubles, which the scene language's are: the shortest text of a float is another number.
std::string numbers(const auto& values) {
  return fmt::format("{}", fmt::join(std::vector<double>(values.begin(), values.end()), ", "));
}

std::vector<double> elements(const Matrix4& m) {
  std::vector<double> list;
  for (const auto& row : m) list.insert(list.end(), row.begin(), row.end());
  return list;
}

/// Adds a plugin as an element; returns it.
pugi::xml_node add_plugin(pugi::xml_node& parent, const char* tag, const Plugin& plugin);

/// Writes one parameter into a plugin's element.
class ParameterWriter {
 public:
  ParameterWriter(pugi::xml_node& plugin, const std::string& name) : plugin_(plugin), name_(name) {}

  void operator()(bool value) { add("boolean", value ? "true" : "false"); }
  void operator()(int value) { add("integer", fmt::format("{}", value)); }
  void operator()(double value) { add("float", fmt::format("{}", value)); }
  void operator()(const char* value) { add("string", value); }
  void operator()(const std::string& value) { add("string", value); }
  void operator()(const Rgb& c) { add("color", numbers(std::array{c.r, c.g, c.b})); }
  void operator()(const Vector3& value) { add("point", numbers(value)); }
  void operator()(const Matrix4& value) {
    add_transform("matrix").append_attribute("value") = numbers(elements(value)).c_str();
  }
  void operator()(const LookAt& l) {
    pugi::xml_node step = add_transform("lookat");
    step.append_attribute("origin") = numbers(l.origin).c_str();
    step.append_attribute("target") = numbers(l.target).c_str();
    step.append_attribute("up") = numbers(l.up).c_str();
  }
  void operator()(const std::vector<Plugin>& nested) {
    for (const Plugin& plugin : nested) {
      const bool is_filter = name_ == "rfilter";
      pugi::xml_node node = add_plugin(plugin_, is_filter ? "rfilter" : "texture", plugin);
      if (!is_filter) node.append_attribute("name") = name_.c_str();
    }
  }

 private:
  void add(const char* tag, const std::string& value) {
    pugi::xml_node node = plugin_.append_child(tag);
    node.append_attribute("name") = name_.c_str();
    node.append_attribute("value") = value.c_str();
  }
  pugi::xml_node add_transform(const char* step) {
    pugi::xml_node node = plugin_.append_child("transform");
    node.append_attribute("name") = name_.c_str();
    return node.append_child(step);
  }

  pugi::xml_node& plugin_;
  const std::string& name_;
};

pugi::xml_node add_plugin(pugi::xml_node& parent, const char* tag, const Plugin& plugin) {
  pugi::xml_node node = parent.append_child(tag);
  node.append_attribute("type") = plugin.type.c_str();
  for (const Parameter& p : plugin.parameters) std::visit(ParameterWriter(node, p.name), p.value);
  return node;
}

/// Throws InputError about a mesh that cannot be.
[[noreturn]] void fail(const Mesh& mesh, const std::string& message) {
  throw InputError(mesh.where, fmt::format("{}: {}", mesh.name, message));
}

/// Throws InputError unless all numbers are finite and there is one attribute a position, or none.
template <typename From, typename To>
void convert(const Mesh& mesh, const char* what, const std::vector<From>& from,
             std::size_t expected, std::vector<To>& to) {
  if (!from.empty() && from.size() != expected)
    fail(mesh, fmt::format("{} {} for {} positions", from.size(), what, expected));
  to.reserve(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    To value(0);
    for (std::size_t k = 0; k < from[i].size(); ++k) {
      if (!std::isfinite(from[i][k]))
        fail(mesh, fmt::format("number {} of the {} is not finite", i, what));
      value[static_cast<int>(k)] = from[i][k];
    }
    to.push_back(value);
  }
}

Mesh make_mesh(const TriangleMesh& from, std::size_t number) {
  Mesh mesh;
  mesh.name = fmt::format("mesh {}", number);
  mesh.where.file = memory_place;
  convert(mesh, "positions", from.positions, from.positions.size(), mesh.positions);
  convert(mesh, "normals", from.normals, from.positions.size(), mesh.normals);
  convert(mesh, "texture coordinates", from.texcoords, from.positions.size(), mesh.texcoords);
  for (const auto& [a, b, c] : from.triangles) {
    if (std::max({a, b, c}) >= from.positions.size())
      fail(mesh,
           fmt::format("triangle {} has the corner {}, but there are {} positions",
                       mesh.position_indices.size(), std::max({a, b, c}), from.positions.size()));
    mesh.position_indices.emplace_back(a, b, c);
  }
  if (!mesh.normals.empty()) mesh.normal_indices = mesh.position_indices;
  if (!mesh.texcoords.empty()) mesh.texcoord_indices = mesh.position_indices;
  return mesh;
}

}  // namespace

struct SceneMaker::Parts {
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("scene");
  std::vector<Mesh> meshes;
};

SceneMaker::SceneMaker() : parts_(std::make_unique<Parts>()) {}
SceneMaker::~SceneMaker() = default;
SceneMaker::SceneMaker(SceneMaker&&) noexcept = default;
SceneMaker& SceneMaker::operator=(SceneMaker&&) noexcept = default;

SceneMaker& SceneMaker::camera(const Plugin& plugin) {
  add_plugin(parts_->root, "camera", plugin);
  return *this;
}

SceneMaker& SceneMaker::sampler(const Plugin& plugin) {
  add_plugin(parts_->root, "sampler", plugin);
  return *this;
}

SceneMaker& SceneMaker::integrator(const Plugin& plugin) {
  add_plugin(parts_->root, "integrator", plugin);
  return *this;
}

SceneMaker& SceneMaker::emitter(const Plugin& plugin) {
  add_plugin(parts_->root, "emitter", plugin);
  return *this;
}

SceneMaker& SceneMaker::mesh(const TriangleMesh& mesh, const Plugin& bsdf) {
  parts_->meshes.push_back(make_mesh(mesh, parts_->meshes.size()));
  pugi::xml_node node = add_plugin(parts_->root, "mesh", {"memory"});
  add_plugin(node, "bsdf", bsdf);
  return *this;
}

SceneMaker& SceneMaker::mesh(const TriangleMesh& triangles, const Plugin& bsdf,
                             const Plugin& emitter) {
  mesh(triangles, bsdf);
  pugi::xml_node node = parts_->root.last_child();
  add_plugin(node, "emitter", emitter);
  return *this;
}

ScenePtr SceneMaker::scene(const LoadOptions& options) const {
  std::ostringstream text;
  parts_->document.save(text);
  const XmlDocument xml(memory_place, text.str());
  Diagnostics diagnostics({options.strict, options.assets_below});
  xml.add_inputs(diagnostics);
  Scene scene = SceneReader(xml, diagnostics).read(xml.root(), parts_->meshes);
  scene.file.clear();
  tell_warnings(diagnostics, options);
  return std::make_shared<const Scene>(std::move(scene));
}

}  // namespace facet
