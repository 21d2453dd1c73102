#include "scene/test_reader.h"

#include "core/text.h"
#include "scene/plugins.h"
#include "scene/scene_reader.h"

namespace facet {

namespace {

/// A <string> of numbers between commas and blanks.
std::vector<double> read_list(PropertyReader& p, const std::string& name) {
  const std::string text = p.string(name, "");
  std::vector<double> numbers;
  for (const std::string_view part : split_list(text)) {
    const auto number = parse_real(part);
    if (!number) p.fail(name, fmt::format("holds \"{}\", which is no number", part));
    numbers.push_back(*number);
  }
  return numbers;
}

TTest read_t_test(PropertyReader& p) {
  TTest test;
  test.angles = read_list(p, "angles");
  for (const double angle : test.angles) {
    if (angle < 0 || angle > 180)
      p.fail("angles",
             fmt::format("holds {:g}, but an angle lies between 0 and 180 degrees", angle));
  }
  test.references = read_list(p, "references");
  test.sample_count = p.integer("sampleCount", test.sample_count, 2, 1 << 30);
  return test;
}

ChiSquaredTest read_chi_squared_test(PropertyReader& p) {
  ChiSquaredTest test;
  test.resolution = p.integer("resolution", test.resolution, 1, 1000);
  test.least_expected =
      p.integer("minExpFrequency", static_cast<int>(test.least_expected), 1, 1 << 30);
  test.sample_count = p.integer("sampleCount", test.sample_count, -1, 1 << 30);
  if (test.sample_count == 0)
    p.fail("sampleCount", "is 0, but must be -1 (5000 a bin) or positive");
  test.direction_count = p.integer("testCount", test.direction_count, 1, 1 << 20);
  return test;
}

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

std::size_t StatisticalTest::case_count() const {
  if (const auto* t = std::get_if<TTest>(&kind))
    return scenes.size() + bsdfs.size() * t->angles.size();
  return bsdfs.size() * static_cast<std::size_t>(std::get<ChiSquaredTest>(kind).direction_count);
}

StatisticalTest read_test(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const XmlDocument xml(path);
  diagnostics.add_inputs(xml.files());
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
    test.kind = read_t_test(p);
  } else if (p.type() == "chi2test") {
    test.kind = read_chi_squared_test(p);
  } else {
    fail_unknown_type(p, "test");
  }
  test.significance = p.real_above("significanceLevel", test.significance, 0);
  if (test.significance >= 1) p.fail("significanceLevel", "must be less than 1");
  read_subjects(xml, p, test, diagnostics);
  check_references(p, test);
  p.finish(diagnostics);
  return test;
}

}  // namespace facet
