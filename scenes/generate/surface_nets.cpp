#include "surface_nets.h"

#include <array>
#include <cstddef>

namespace facet::generate {
namespace {

constexpr std::size_t block_size = 6;
constexpr std::uint32_t no_vertex = 0xffffffffu;

/// Field values at the nodes and vertex numbers of the cells, both at the index of their lowest
/// corner.
class SurfaceNets {
 public:
  SurfaceNets(const Field& field, const Grid& grid)
      : field_(field), grid_(grid), size_{grid.x.size(), grid.y.size(), grid.z.size()} {
    values_.resize(size_[0] * size_[1] * size_[2]);
    vertices_.resize(values_.size(), no_vertex);
  }

  Mesh run() {
    sample_field();
    for_each_cell([this](std::size_t i, std::size_t j, std::size_t k) { place_vertex(i, j, k); });
    for_each_cell([this](std::size_t i, std::size_t j, std::size_t k) {
      connect_edges({i, j, k});
    });
    return std::move(mesh_);
  }

 private:
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
    return (k * size_[1] + j) * size_[0] + i;
  }
  Vec3 node(std::size_t i, std::size_t j, std::size_t k) const {
    return {grid_.x[i], grid_.y[j], grid_.z[k]};
  }

  template <typename Visit>
  void for_each_cell(const Visit& visit) const {
    for (std::size_t k = 0; k + 1 < size_[2]; ++k) {
      for (std::size_t j = 0; j + 1 < size_[1]; ++j) {
        for (std::size_t i = 0; i + 1 < size_[0]; ++i) visit(i, j, k);
      }
    }
  }

  void sample_field() {
    for (std::size_t k = 0; k < size_[2]; k += block_size) {
      for (std::size_t j = 0; j < size_[1]; j += block_size) {
        for (std::size_t i = 0; i < size_[0]; i += block_size) sample_block(i, j, k);
      }
    }
  }

  /// Far from the surface one sample stands for a whole block: only its sign is used then.
  void sample_block(std::size_t i0, std::size_t j0, std::size_t k0) {
    const std::size_t i1 = std::min(i0 + block_size, size_[0]);
    const std::size_t j1 = std::min(j0 + block_size, size_[1]);
    const std::size_t k1 = std::min(k0 + block_size, size_[2]);
    // One cell of overlap to each side, so that an edge into the neighbouring block counts as well.
    const Vec3 low = node(i0 > 0 ? i0 - 1 : 0, j0 > 0 ? j0 - 1 : 0, k0 > 0 ? k0 - 1 : 0);
    const Vec3 high =
        node(std::min(i1, size_[0] - 1), std::min(j1, size_[1] - 1), std::min(k1, size_[2] - 1));
    const double centre_value = field_((low + high) * 0.5);
    const bool far = std::abs(centre_value) > 1.5 * 0.5 * length(high - low);
    for (std::size_t k = k0; k < k1; ++k) {
      for (std::size_t j = j0; j < j1; ++j) {
        for (std::size_t i = i0; i < i1; ++i)
          values_[index(i, j, k)] = far ? centre_value : field_(node(i, j, k));
      }
    }
  }

  Vec3 gradient(Vec3 p, double step) const {
    // Four samples at the corners of a tetrahedron instead of six on the axes.
    constexpr std::array<Vec3, 4> corners{{{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}}};
    Vec3 sum;
    for (const Vec3& corner : corners) sum = sum + corner * field_(p + corner * step);
    return sum * (0.25 / step);
  }

  void place_vertex(std::size_t i, std::size_t j, std::size_t k) {
    Vec3 sum;
    int crossings = 0;
    const auto visit_edge = [&](std::array<std::size_t, 3> from, std::size_t axis) {
      std::array<std::size_t, 3> to = from;
      ++to[axis];
      const double a = values_[index(from[0], from[1], from[2])];
      const double b = values_[index(to[0], to[1], to[2])];
      if ((a < 0) == (b < 0)) return;
      const Vec3 start = node(from[0], from[1], from[2]);
      sum = sum + start + (node(to[0], to[1], to[2]) - start) * (a / (a - b));
      ++crossings;
    };
    for (std::size_t n = 0; n < 4; ++n) {
      const std::size_t s = n & 1u;
      const std::size_t t = n >> 1u;
      visit_edge({i, j + s, k + t}, 0);
      visit_edge({i + s, j, k + t}, 1);
      visit_edge({i + s, j + t, k}, 2);
    }
    if (crossings == 0) return;
    vertices_[index(i, j, k)] = static_cast<std::uint32_t>(mesh_.positions.size());
    add_vertex(sum * (1.0 / crossings), length(node(i + 1, j + 1, k + 1) - node(i, j, k)));
  }

  /// Two Newton steps towards the surface, none longer than a fraction of the cell: no vertex may
  /// change sides with another.
  void add_vertex(Vec3 p, double cell_diagonal) {
    const double step = 0.12 * cell_diagonal;
    for (int iteration = 0; iteration < 2; ++iteration) {
      const Vec3 slope = gradient(p, step);
      const Vec3 move = slope * (-field_(p) / std::max(dot(slope, slope), 0.1));
      const double longest = 0.25 * cell_diagonal;
      p = p + move * std::min(1.0, longest / std::max(length(move), 1e-12));
    }
    const Vec3 slope = gradient(p, step);
    mesh_.positions.push_back(p);
    mesh_.normals.push_back(length(slope) > 1e-6 ? normalize(slope) : Vec3{0, 1, 0});
  }

  void connect_edges(std::array<std::size_t, 3> cell) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      if (cell[u] == 0 || cell[v] == 0) continue;
      std::array<std::size_t, 3> end = cell;
      ++end[axis];
      const bool inside_start = values_[index(cell[0], cell[1], cell[2])] < 0;
      const bool inside_end = values_[index(end[0], end[1], end[2])] < 0;
      if (inside_start == inside_end) continue;
      const auto vertex_at = [&](std::size_t du, std::size_t dv) {
        std::array<std::size_t, 3> at = cell;
        at[u] -= du;
        at[v] -= dv;
        return vertices_[index(at[0], at[1], at[2])];
      };
      const std::array<std::uint32_t, 4> quad{vertex_at(1, 1), vertex_at(0, 1), vertex_at(0, 0),
                                              vertex_at(1, 0)};
      if (inside_start)
        add_quad(quad[0], quad[1], quad[2], quad[3]);
      else
        add_quad(quad[3], quad[2], quad[1], quad[0]);
    }
  }

  /// Splits a quadrilateral along its shorter diagonal.
  void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    const auto& p = mesh_.positions;
    const bool split_ac = length(p[a] - p[c]) <= length(p[b] - p[d]);
    const auto add = [this](std::uint32_t r, std::uint32_t s, std::uint32_t t) {
      mesh_.triangles.push_back({Mesh::Corner{r, r}, Mesh::Corner{s, s}, Mesh::Corner{t, t}});
    };
    if (split_ac) {
      add(a, b, c);
      add(a, c, d);
    } else {
      add(a, b, d);
      add(b, c, d);
    }
  }

  const Field& field_;
  const Grid& grid_;
  std::array<std::size_t, 3> size_;
  std::vector<double> values_;
  std::vector<std::uint32_t> vertices_;
  Mesh mesh_;
};

}  // namespace

std::vector<double> make_stations(double low, double high,
                                  const std::function<double(double)>& spacing) {
  std::vector<double> stations{low};
  while (stations.back() < high) stations.push_back(stations.back() + spacing(stations.back()));
  return stations;
}

Mesh polygonise(const Field& field, const Grid& grid) { return SurfaceNets(field, grid).run(); }

}  // namespace facet::generate
