#pragma once
// The pipeline of LDR-FLIP (flip.h) on linear planes.
#include <array>
#include <cstddef>
#include <vector>

namespace facet {

using Plane = std::vector<float>;
/// Red, green and blue; linear, in [0, 1].
using RgbPlanes = std::array<Plane, 3>;

/// Makes maps of differences for images of one size and one viewing distance.
class FlipMap {
 public:
  FlipMap(int width, int height, double pixels_per_degree);

  /// Each pixel's difference, in [0, 1].
  [[nodiscard]] Plane compare(const RgbPlanes& a, const RgbPlanes& b) const;

 private:
  /// An odd number of weights around a centre.
  using Kernel = std::vector<float>;
  struct Features {
    Plane edges;   ///< length of the gradient, both derivatives in [-1, 1]
    Plane points;  ///< length of the second derivatives, likewise
  };

  [[nodiscard]] Plane filter(const Plane& plane, const Kernel& horizontal,
                             const Kernel& vertical) const;
  [[nodiscard]] Plane length_of_gradient(const Plane& plane, const Kernel& derivative) const;
  [[nodiscard]] RgbPlanes to_opponent(const RgbPlanes& rgb) const;
  [[nodiscard]] RgbPlanes to_perceived(const RgbPlanes& opponent) const;
  [[nodiscard]] Features find_features(const Plane& luminance) const;

  std::size_t width_;
  std::size_t height_;
  Kernel luminance_;
  Kernel red_green_;
  std::array<Kernel, 2> blue_yellow_;
  std::array<float, 2> blue_yellow_weights_{};
  Kernel smooth_;
  Kernel edge_;
  Kernel point_;
};

}  // namespace facet
