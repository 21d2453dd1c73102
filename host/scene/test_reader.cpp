#include "scene/test_reader.h"

#include "core/memory.h"
#include "scene/plugin/parameter_reader.h"
#include "scene/plugins.h"
#include "scene/scene_reader.h"

namespace facet {

namespace {

/// The objects under test.
void read_subjects(const XmlDocument& xml, PropertyReader& p, StatisticalTest& test,
                   Diagnostics& diagnostics) {
  for (const pugi::xml_node& node : p.children("bsdf")) {
    SceneReader reader(xml, diagnostics);
    test.bsdfs.push_back({reader.read_bsdf(node), title_of(node), xml.location(node)});
    if (reader.has_textures())
      throw InputError(xml.location(node),
                       "a BSDF under test cannot have textures: it lies on no mesh");
  }
  for (const pugi::xml_node& node : p.children("scene")) {
    if (std::holds_alternative<ChiSquaredTest>(test.kind))
      throw InputError(xml.location(node),
                       fmt::format("{} cannot hold a scene, only BSDFs", p.title()));
    if (!test.bsdfs.empty())
      throw InputError(xml.location(node),
                       fmt::format("{} holds both BSDFs and scenes", p.title()));
    test.scenes.push_back({SceneReader(xml, diagnostics).read(node), xml.location(node)});
    if (test.scenes.back().scene.integrator.type.name.empty())
      throw InputError(xml.location(node), "the scene has no integrator");
  }
  if (test.bsdfs.empty() && test.scenes.empty())
    throw InputError(p.location(), fmt::format("{} holds nothing to test", p.title()));
}

/// Throws where the numbers of references, angles and subjects do not fit.
void check_references(const PropertyReader& p, const StatisticalTest& test) {
  const auto* t = std::get_if<TTest>(&test.kind);
  if (t == nullptr) return;
  const std::size_t count = t->references.size();
  if (!test.scenes.empty()) {
    if (!t->angles.empty()) p.fail("angles", "are for BSDFs, but the test holds scenes");
    if (count != test.scenes.size())
      p.fail("references", fmt::format("hold {} numbers for {} scenes; one for each expected",
                                       count, test.scenes.size()));
    return;
  }
  if (t->angles.empty())
    p.fail("angles", "are missing: the directions from which the BSDFs are seen");
  if (count != test.case_count()) {
    p.fail("references",
           fmt::format(
               "hold {} numbers for {} angles and {} BSDFs; one per angle for each BSDF expected",
               count, t->angles.size(), test.bsdfs.size()));
  }
}

}  // namespace

void TTest::check(const PropertyReader& properties) const {
  for (const double angle : angles) {
    if (angle < 0 || angle > 180)
      properties.fail(
          "angles", fmt::format("holds {:g}, but an angle lies between 0 and 180 degrees", angle));
  }
}

void ChiSquaredTest::check(const PropertyReader& properties) const {
  if (sample_count == 0)
    properties.fail("sampleCount", "is 0, but must be -1 (5000 a bin) or positive");
}

double StatisticalTest::significance() const {
  return std::visit([](const auto& test) { return test.significance; }, kind);
}

std::size_t StatisticalTest::case_count() const {
  if (const auto* t = std::get_if<TTest>(&kind))
    return scenes.size() + bsdfs.size() * t->angles.size();
  return bsdfs.size() * static_cast<std::size_t>(std::get<ChiSquaredTest>(kind).direction_count);
}

StatisticalTest read_test(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const Activity activity("reading the test " + path.string());
  diagnostics.add_input({}, path);
  const XmlDocument xml(path);
  xml.add_inputs(diagnostics);
  const pugi::xml_node root = xml.root();
  if (std::string_view(root.name()) == "scene") {
    throw InputError(
        xml.location(root),
        fmt::format("this is a <scene>; render it with: facet render {}", path.string()));
  }
  if (std::string_view(root.name()) != "test")
    throw InputError(xml.location(root),
                     fmt::format("the root is <{}>; <test> expected", root.name()));
  if (!root.attribute("type"))
    throw InputError(xml.location(root), "<test> lacks the attribute \"type\"");
  PropertyReader p(xml, root);
  StatisticalTest test;
  test.file = path;
  if (p.type() == "ttest") {
    test.kind = read_parameters<TTest>(p);
  } else if (p.type() == "chi2test") {
    test.kind = read_parameters<ChiSquaredTest>(p);
  } else {
    fail_unknown_type(p, "test");
  }
  read_subjects(xml, p, test, diagnostics);
  check_references(p, test);
  p.finish(diagnostics);
  return test;
}

}  // namespace facet
