#pragma once
// A test file as plain typed data: Nori's statistical tests.
#include <variant>

#include "scene/scene.h"

namespace facet {

/* ttest: Student's t-test of means; `facet test` runs it.

   | parameter         | default | meaning                                                          |
   |-------------------|---------|------------------------------------------------------------------|
   | references        |         | expected means, one per angle for each bsdf in turn, or one per scene |
   | angles            |         | of the viewer to the normal, degrees; none for scenes            |
   | sampleCount       | 100000  | samples of each mean                                             |
   | significanceLevel | 0.01    | probability that correct code fails any case                     |

   Holds bsdfs, whose mean sample weight is tested, or scenes, whose mean radiance is. */

/// Student's t-test of means: of BSDFs' sample weights under given angles, or of scenes' images.
struct TTest {
  std::vector<double> angles;      ///< of the viewer to the normal, degrees; empty for scenes
  std::vector<double> references;  ///< one per angle for each BSDF in turn, or one per scene
  int sample_count = 100000;
};

/* chi2test: Pearson's chi^2 test of a BSDF's samples against its density; `facet test` runs it.

   | parameter         | default | meaning                                              |
   |-------------------|---------|------------------------------------------------------|
   | resolution        | 10      | bins along cos theta; twice as many along phi        |
   | minExpFrequency   | 5       | bins that expect fewer samples are pooled            |
   | sampleCount       | -1      | samples a direction; -1: 5000 a bin                  |
   | testCount         | 5       | directions of the viewer for each bsdf               |
   | significanceLevel | 0.01    | probability that correct code fails any case         |

   Holds bsdfs. */

/// Pearson's chi^2 test of a BSDF's samples against its density.
struct ChiSquaredTest {
  int resolution = 10;        ///< bins along cos theta; twice as many along phi
  double least_expected = 5;  ///< bins that expect fewer samples are pooled
  int sample_count = -1;      ///< per direction; -1: 5000 a bin
  int direction_count = 5;    ///< viewers per BSDF
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
  double significance = 0.01;  ///< probability that correct code fails any of the cases
  std::variant<TTest, ChiSquaredTest> kind;
  std::vector<TestedBsdf> bsdfs;
  std::vector<TestedScene> scenes;  ///< empty where there are BSDFs

  /// Cases: pairs of BSDF and direction, or scenes.
  [[nodiscard]] std::size_t case_count() const;
};

}  // namespace facet
