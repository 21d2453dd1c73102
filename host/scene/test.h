#pragma once
// A test file as plain typed data: Nori's statistical tests.
#include <variant>

#include "scene/scene.h"

namespace facet {

class PropertyReader;

/* ttest: Student's t-test of means; `facet test` runs it.

   Holds bsdfs, whose mean sample weight is tested, or scenes, whose mean radiance is. */

/// Student's t-test of means: of BSDFs' sample weights under given angles, or of scenes' images.
struct TTest {
  std::vector<double> angles;      ///< of the viewer to the normal, degrees; empty for scenes
  std::vector<double> references;  ///< one per angle for each BSDF in turn, or one per scene
  int sample_count = 100000;
  double significance = 0.01;  ///< probability that correct code fails any of the cases

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    using namespace parameter;
    visit("references", p.references, Numbers{},
          "expected means, one per angle for each bsdf in turn, or one per scene");
    visit("angles", p.angles, Numbers{}, "of the viewer to the normal, degrees; none for scenes");
    visit("sampleCount", p.sample_count, Count{2, 1 << 30}, "samples of each mean");
    visit("significanceLevel", p.significance, Inside{0, 1},
          "probability that correct code fails any case");
  }
  /// Throws InputError where an angle is none.
  void check(const PropertyReader& properties) const;
};

/* chi2test: Pearson's chi^2 test of a BSDF's samples against its density; `facet test` runs it.

   Holds bsdfs. */

/// Pearson's chi^2 test of a BSDF's samples against its density.
struct ChiSquaredTest {
  int resolution = 10;         ///< bins along cos theta; twice as many along phi
  double least_expected = 5;   ///< bins that expect fewer samples are pooled
  int sample_count = -1;       ///< per direction; -1: 5000 a bin
  int direction_count = 5;     ///< viewers per BSDF
  double significance = 0.01;  ///< probability that correct code fails any of the cases

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    using namespace parameter;
    visit("resolution", p.resolution, Count{1, 1000},
          "bins along cos theta; twice as many along phi");
    visit("minExpFrequency", p.least_expected, Count{1, 1 << 30},
          "bins that expect fewer samples are pooled");
    visit("sampleCount", p.sample_count, Count{-1, 1 << 30}, "samples a direction; -1: 5000 a bin");
    visit("testCount", p.direction_count, Count{1, 1 << 20},
          "directions of the viewer for each bsdf");
    visit("significanceLevel", p.significance, Inside{0, 1},
          "probability that correct code fails any case");
  }
  /// Throws InputError where there are no samples.
  void check(const PropertyReader& properties) const;
};

/// A BSDF under test: how it is called in the file, and where it stands.
struct TestedBsdf {
  Bsdf bsdf;  ///< without textures
  std::string title;
  SourceLocation where;
};

struct TestedScene {
  Scene scene;
  SourceLocation where;
};

struct StatisticalTest {
  std::filesystem::path file;
  std::variant<TTest, ChiSquaredTest> kind;
  std::vector<TestedBsdf> bsdfs;
  std::vector<TestedScene> scenes;  ///< empty where there are BSDFs

  /// Cases: pairs of BSDF and direction, or scenes.
  [[nodiscard]] std::size_t case_count() const;
  /// Probability that correct code fails any of the cases.
  [[nodiscard]] double significance() const;
};

}  // namespace facet
