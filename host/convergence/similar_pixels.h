#pragma once
// What a pixel should look like by pixels whose surroundings look alike.
#include <vector>

#include "convergence/relative_variance.h"

namespace facet {

/// Non-local means (A. Buades et al., "A Non-Local Algorithm for Image Denoising", CVPR 2005) that
/// heed the variance of the pixels (F. Rousselle et al., "Adaptive Rendering with Non-Local Means
/// Filtering", ACM TOG 31(6), 2012). Two pixels are compared by their eight neighbours, not by
/// themselves: one that has seen a flash which its like have missed is alike still.
class SimilarPixels {
 public:
  /// film: with squares; it must outlive this.
  SimilarPixels(const Film& film, double epsilon);

  /// A mean, and what it rests on: as many equally bright samples among black ones as would give
  /// its relative variance.
  struct Mean {
    Color3 value{};
    Color3 flashes{};
  };
  /// Of the pixels that are like this, itself among them, within a square of 21 pixels.
  [[nodiscard]] Mean mean(int x, int y) const;

 private:
  /// How likely the neighbours of two pixels would differ as they do if they were the same, from 0
  /// to 1.
  [[nodiscard]] double likeness(int x, int y, int other_x, int other_y) const;
  /// The squared difference of two pixels over its variance, of their channels' mean.
  [[nodiscard]] double difference(std::size_t a, std::size_t b) const;

  const Film& film_;
  double epsilon_;  ///< of relMSE
  std::vector<Color3> means_;
  std::vector<Color3> own_variances_;  ///< of the means
  std::vector<Color3> variances_;      ///< the mean of it and its neighbours'
};

}  // namespace facet
