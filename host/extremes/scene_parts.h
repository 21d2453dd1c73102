#pragma once
// Scenes for checks, made in memory, and what renders of them say.
#include <facet/facet.h>

#include "extremes/bench.h"

namespace facet::extremes {

[[nodiscard]] inline Rgb gray(float x) { return {x, x, x}; }

/// Counter-clockwise seen from the front.
[[nodiscard]] TriangleMesh quad(const Vector3& a, const Vector3& b, const Vector3& c,
                                const Vector3& d);

/// The box about the origin with these half lengths, seen from outside; `inwards`: from inside.
[[nodiscard]] TriangleMesh box(const Vector3& half, bool inwards = false);

/// A square in the plane y = `height`, of side 2 about the y axis, facing up or down, in
/// count x count squares of two triangles.
[[nodiscard]] TriangleMesh grid(int count, float height, bool up);

/// A ball of radius 1 about the origin, of 8 * 4^level triangles, their vertices at
/// `radius(direction)`.
[[nodiscard]] TriangleMesh ball(int level, const std::function<float(const Vector3&)>& radius);

/// Adds the triangles of another mesh, which has neither normals nor texture coordinates.
void append(TriangleMesh& mesh, const TriangleMesh& other);

/// Each coordinate times its scale, plus offset, rounded to float once.
[[nodiscard]] TriangleMesh moved(TriangleMesh mesh, const Vector3& scale, const Vector3& offset);

/// A camera of type "perspective".
[[nodiscard]] Plugin camera(ImageSize size, double fov, const LookAt& to_world);

/// A scene at the edge, for whoever else renders it.
struct EdgeScene {
  std::string name;
  std::function<ScenePtr()> scene;
  std::string argued = {};  ///< why kernels and reference may differ in it; empty: they may not
};

/// Scenes of surface_checks(), light_checks(), image_checks(), scene_checks().
[[nodiscard]] std::vector<EdgeScene> surface_scenes();
[[nodiscard]] std::vector<EdgeScene> light_scenes();
[[nodiscard]] std::vector<EdgeScene> image_scenes();
[[nodiscard]] std::vector<EdgeScene> whole_scenes();

/// A rendering that is through.
struct Rendered {
  Film film;
  RenderStatistics statistics;

  /// The mean of all pixels' first channel, and its standard error by their spread: for images
  /// whose pixels have one expected value. NaN where samples were dropped, or traversals
  /// stopped by their bound.
  [[nodiscard]] double mean() const;
  [[nodiscard]] double standard_error() const;
  /// Samples that are not 0.
  [[nodiscard]] std::uint64_t nonzero() const;
  /// R, G, B; all NaN where samples were dropped, or traversals stopped by their bound.
  [[nodiscard]] Image image() const;
};

[[nodiscard]] Rendered rendered(Bench& bench, const ScenePtr& scene,
                                const RenderRequest& request = {});

/// Calls body(a, b) for the values of two images of one size.
template <typename Body>
void for_each_value(const Image& a, const Image& b, const Body& body) {
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      for (int c = 0; c < 3; ++c)
        body(static_cast<double>(a.at(x, y, c)), static_cast<double>(b.at(x, y, c)));
    }
  }
}

/// Largest relative error of a channel of an image that is `right` everywhere; NaN where one is.
[[nodiscard]] double largest_error(const Image& image, double right);

/// Channels that differ.
[[nodiscard]] double count_different(const Image& a, const Image& b);

}  // namespace facet::extremes
