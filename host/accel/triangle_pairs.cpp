#include "accel/triangle_pairs.h"

#include <bit>
#include <optional>

#include "core/parallel.h"

namespace facet {

namespace {

/// Slots of the table of edges that a search looks at, at most, so that no input makes it slow: one
/// where very many triangles share an edge, say.
constexpr std::size_t most_probes = 32;

/// Edge e of a triangle runs from corner e to the next.
std::uint8_t next(std::uint8_t corner) {
  return corner == 2 ? 0 : static_cast<std::uint8_t>(corner + 1);
}

bool is_same_edge(const TriangleCorners& a, std::uint8_t e, const TriangleCorners& b,
                  std::uint8_t f) {
  const vec3& a0 = a[e];
  const vec3& a1 = a[next(e)];
  const vec3& b0 = b[f];
  const vec3& b1 = b[next(f)];
  return (a0 == b1 && a1 == b0) || (a0 == b0 && a1 == b1);
}

class Joiner {
 public:
  explicit Joiner(std::span<const TriangleCorners> triangles)
      : triangles_(triangles), pairs_(triangles.size()), taken_(triangles.size()) {}

  std::vector<TrianglePair> join() {
    join_successive();
    join_by_edges();
    std::size_t count = 0;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (pairs_[i].second != none || taken_[i] == 0) pairs_[count++] = pairs_[i];
    }
    pairs_.resize(count);
    return std::move(pairs_);
  }

 private:
  static constexpr std::size_t grain = 1U << 12U;

  /// Files list a mesh's triangles by strips, quads or fans: most find a partner in the next.
  void join_successive() {
    parallel_for(triangles_.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) pairs_[i].first = static_cast<std::uint32_t>(i);
      for (std::size_t i = begin; i + 1 < end; ++i) {
        if (taken_[i] != 0) continue;
        for (std::uint8_t e = 0; e < 9; ++e) {
          if (try_to_join(i, e / 3, i + 1, e % 3)) break;
        }
      }
    });
  }

  bool try_to_join(std::size_t first, int edge, std::size_t second, int other_edge) {
    const auto e = static_cast<std::uint8_t>(edge);
    const auto f = static_cast<std::uint8_t>(other_edge);
    if (!is_same_edge(triangles_[first], e, triangles_[second], f)) return false;
    if (!(joint_area(first, second) <= area(first) + area(second))) return false;
    join(first, e, second, f);
    return true;
  }

  void join(std::size_t first, std::uint8_t edge, std::size_t second, std::uint8_t other_edge) {
    // The edge is to run from corner 2 of the pair to corner 0.
    pairs_[first] = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second),
                     next(edge), next(next(other_edge))};
    taken_[first] = taken_[second] = 1;
  }

  [[nodiscard]] float area(std::size_t triangle) const {
    return bounds_of(triangles_[triangle]).half_area();
  }

  [[nodiscard]] float joint_area(std::size_t first, std::size_t second) const {
    Box box = bounds_of(triangles_[first]);
    box.add(bounds_of(triangles_[second]));
    return box.half_area();
  }

  /// The others look for the neighbour with which they share the smallest box, in a table of the
  /// edges of those before them that found none.
  void join_by_edges() {
    std::vector<std::uint32_t> left;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (taken_[i] == 0) left.push_back(static_cast<std::uint32_t>(i));
    }
    table_.assign(std::bit_ceil(6 * left.size() + 1), none);
    for (const std::uint32_t i : left) {
      if (const auto partner = find_partner(i)) {
        join(partner->triangle, partner->edge, i, partner->own_edge);
      } else {
        for (std::uint8_t e = 0; e < 3; ++e) insert(i, e);
      }
    }
  }

  struct Partner {
    std::uint32_t triangle;
    std::uint8_t edge;
    std::uint8_t own_edge;
  };

  [[nodiscard]] std::optional<Partner> find_partner(std::uint32_t i) const {
    std::optional<Partner> best;
    float excess = 0;  ///< of the box of two over their boxes together
    for (std::uint8_t e = 0; e < 3; ++e) {
      std::size_t slot = slot_of(i, e);
      for (std::size_t probe = 0; probe < most_probes && table_[slot] != none; ++probe) {
        const std::uint32_t other = table_[slot] / 3;
        const auto f = static_cast<std::uint8_t>(table_[slot] % 3);
        slot = (slot + 1) & (table_.size() - 1);
        if (taken_[other] != 0 || !is_same_edge(triangles_[other], f, triangles_[i], e)) continue;
        const float its_excess = joint_area(other, i) - (area(other) + area(i));
        if (!(its_excess <= excess)) continue;
        excess = its_excess;
        best = Partner{other, f, e};
      }
    }
    return best;
  }

  void insert(std::uint32_t i, std::uint8_t e) {
    std::size_t slot = slot_of(i, e);
    for (std::size_t probe = 0; probe < most_probes && table_[slot] != none; ++probe)
      slot = (slot + 1) & (table_.size() - 1);
    if (table_[slot] == none) table_[slot] = 3 * i + e;
  }

  /// Alike for both directions of the edge.
  [[nodiscard]] std::size_t slot_of(std::uint32_t i, std::uint8_t e) const {
    const auto hash = [](const vec3& p) {
      std::uint64_t h = 0;
      // 0 is added so that -0 counts as 0.
      for (int a = 0; a < 3; ++a)
        h = (h ^ std::bit_cast<std::uint32_t>(p[a] + 0.0F)) * 0x9e3779b97f4a7c15ULL;
      return h ^ (h >> 32U);
    };
    const std::uint64_t h =
        (hash(triangles_[i][e]) + hash(triangles_[i][next(e)])) * 0x9e3779b97f4a7c15ULL;
    return static_cast<std::size_t>(h >> 20U) & (table_.size() - 1);
  }

  std::span<const TriangleCorners> triangles_;
  std::vector<TrianglePair> pairs_;  ///< of each triangle that is the first of its pair
  std::vector<std::uint8_t> taken_;
  std::vector<std::uint32_t> table_;  ///< three times a triangle's index, and the edge
};

}  // namespace

std::vector<TrianglePair> pair_triangles(std::span<const TriangleCorners> triangles) {
  return Joiner(triangles).join();
}

}  // namespace facet
