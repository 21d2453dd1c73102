#include "extremes/scene_parts.h"

#include <cmath>
#include <limits>

namespace facet::extremes {

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

Vector3 unit(const Vector3& a) {
  const float length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// Cuts each triangle into four, whose new vertices are on the unit sphere, neighbours sharing
/// them.
TriangleMesh refined(const TriangleMesh& mesh) {
  TriangleMesh result{.positions = mesh.positions, .triangles = {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(result.positions.size()));
    if (is_new) {
      Vector3 sum{};
      for (std::size_t i = 0; i < 3; ++i)
        sum.at(i) = mesh.positions[a].at(i) + mesh.positions[b].at(i);
      result.positions.push_back(unit(sum));
    }
    return place->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middle(a, b);
    const std::uint32_t bc = middle(b, c);
    const std::uint32_t ca = middle(c, a);
    for (const std::array<std::uint32_t, 3>& t : {std::array{a, ab, ca}, std::array{ab, b, bc},
                                                  std::array{ca, bc, c}, std::array{ab, bc, ca}})
      result.triangles.push_back(t);
  }
  return result;
}

}  // namespace

TriangleMesh quad(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  return {.positions = {a, b, c, d}, .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

TriangleMesh box(const Vector3& half, bool inwards) {
  TriangleMesh mesh{.positions = {},
                    .triangles = {{0, 2, 1},
                                  {0, 3, 2},
                                  {4, 5, 6},
                                  {4, 6, 7},
                                  {0, 1, 5},
                                  {0, 5, 4},
                                  {2, 3, 7},
                                  {2, 7, 6},
                                  {1, 2, 6},
                                  {1, 6, 5},
                                  {3, 0, 4},
                                  {3, 4, 7}}};
  for (const float z : {-half[2], half[2]}) {
    mesh.positions.insert(mesh.positions.end(), {{-half[0], -half[1], z},
                                                 {half[0], -half[1], z},
                                                 {half[0], half[1], z},
                                                 {-half[0], half[1], z}});
  }
  if (inwards) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mesh;
}

TriangleMesh grid(int count, float height, bool up) {
  TriangleMesh mesh;
  const auto at = [count](int i) {
    return 2 * static_cast<float>(i) / static_cast<float>(count) - 1;
  };
  for (int j = 0; j <= count; ++j) {
    for (int i = 0; i <= count; ++i) mesh.positions.push_back({at(i), height, at(j)});
  }
  const auto index = [count](int i, int j) {
    return static_cast<std::uint32_t>(j * (count + 1) + i);
  };
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i < count; ++i) {
      const std::uint32_t a = index(i, j);
      const std::uint32_t b = index(i, j + 1);
      const std::uint32_t c = index(i + 1, j + 1);
      const std::uint32_t d = index(i + 1, j);
      mesh.triangles.push_back(up ? std::array{a, b, c} : std::array{a, c, b});
      mesh.triangles.push_back(up ? std::array{a, c, d} : std::array{a, d, c});
    }
  }
  return mesh;
}

TriangleMesh ball(int level, const std::function<float(const Vector3&)>& radius) {
  TriangleMesh mesh{
      .positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      .triangles = {
          {0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int i = 0; i < level; ++i) mesh = refined(mesh);
  for (Vector3& p : mesh.positions) {
    const float r = radius(p);
    for (float& x : p) x *= r;
  }
  return mesh;
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& t : other.triangles)
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

TriangleMesh moved(TriangleMesh mesh, const Vector3& scale, const Vector3& offset) {
  for (Vector3& p : mesh.positions) {
    for (std::size_t i = 0; i < 3; ++i)
      p.at(i) = static_cast<float>(static_cast<double>(p.at(i)) * static_cast<double>(scale.at(i)) +
                                   static_cast<double>(offset.at(i)));
  }
  return mesh;
}

Plugin camera(ImageSize size, double fov, const LookAt& to_world) {
  return {"perspective",
          {{"width", size.width},
           {"height", size.height},
           {"fov", fov},
           {"nearClip", 1e-35},
           {"farClip", 1e35},
           {"toWorld", to_world}}};
}

Rendered rendered(Bench& bench, const ScenePtr& scene, const RenderRequest& request) {
  const std::unique_ptr<Rendering> rendering = bench.backend().start(scene, request);
  rendering->run([&](double done, const RenderStatistics& /*statistics*/) {
    bench.tell(done);
    return true;
  });
  return {rendering->film(), rendering->statistics()};
}

double Rendered::mean() const {
  if (statistics.bad_samples > 0 || statistics.bound_hits > 0) return not_a_number;
  double sum = 0;
  for (const PixelSums& pixel : film.pixels) sum += pixel.mean()[0];
  return sum / static_cast<double>(film.pixels.size());
}

double Rendered::standard_error() const {
  const double middle = mean();
  double sum = 0;
  for (const PixelSums& pixel : film.pixels)
    sum += (pixel.mean()[0] - middle) * (pixel.mean()[0] - middle);
  const auto n = static_cast<double>(film.pixels.size());
  return std::sqrt(sum / (n * (n - 1)));
}

std::uint64_t Rendered::nonzero() const {
  std::uint64_t count = 0;
  for (const PixelSums& pixel : film.pixels) count += pixel.nonzero;
  return count;
}

Image Rendered::image() const {
  Image image = develop(film, false);
  if (statistics.bad_samples > 0 || statistics.bound_hits > 0) {
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        for (int c = 0; c < 3; ++c) image.at(x, y, c) = not_a_number;
      }
    }
  }
  return image;
}

double largest_error(const Image& image, double right) {
  double worst = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (int c = 0; c < 3; ++c) {
        const double error = std::abs(static_cast<double>(image.at(x, y, c)) / right - 1);
        if (std::isnan(error)) return error;
        worst = std::max(worst, error);
      }
    }
  }
  return worst;
}

double count_different(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height())
    return std::numeric_limits<double>::infinity();
  double different = 0;
  for_each_value(a, b, [&](double x, double y) { different += x == y ? 0 : 1; });
  return different;
}

}  // namespace facet::extremes
