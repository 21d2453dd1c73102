#include "accel/binary_bvh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <mutex>

#include "core/parallel.h"
#include "shared/records.h"

namespace facet {

namespace {

constexpr std::size_t bin_count = 16;
/// Levels at most: what cannot be halved by count in those that are left is not split otherwise, so that no
/// input makes a tree too deep for the kernels' stack.
constexpr int most_levels = shared::LARGEST_STACK_SIZE;
/// Nodes of more primitives are binned by all threads; subtrees of fewer are one task.
constexpr std::size_t parallel_size = 1U << 16U;

struct Bin {
  Box box;
  std::uint32_t count = 0;

  void add(const Bin& b) {
    box.add(b.box);
    count += b.count;
  }
};

using Bins = std::array<std::array<Bin, bin_count>, 3>;

struct Bounds {
  Box box;
  Box centres;  ///< of twice the centres

  void add(const BvhPrimitive& p) {
    box.add(p.box);
    centres.add(p.centre2());
  }
  void add(const Bounds& b) {
    box.add(b.box);
    centres.add(b.centres);
  }
};

/// Folds ranges of the primitives into one result; in parallel where there are many. The result does not
/// depend on the order of folding, since it only takes minima, maxima and sums of integers.
template <typename Result, typename Fold>
Result fold(std::span<const BvhPrimitive> primitives, const Result& empty, const Fold& fold_range) {
  Result total = empty;
  std::mutex mutex;
  const auto body = [&](std::size_t begin, std::size_t end) {
    Result part = empty;
    fold_range(part, primitives.subspan(begin, end - begin));
    const std::scoped_lock lock(mutex);
    total.add(part);
  };
  if (primitives.size() > parallel_size) {
    parallel_for(primitives.size(), parallel_size / 4, body);
  } else {
    fold_range(total, primitives);
  }
  return total;
}

/// Which bin a centre falls into along each axis.
struct BinScale {
  vec3 origin;
  vec3 scale;  ///< 0 along axes without extent

  explicit BinScale(const Box& centres) : origin(centres.lower), scale(0) {
    const vec3 extent = centres.extent();
    for (int a = 0; a < 3; ++a) {
      const float s = static_cast<float>(bin_count) * 0.9999F / extent[a];
      if (extent[a] > 0 && std::isfinite(s)) scale[a] = s;
    }
  }
  [[nodiscard]] std::size_t bin(const vec3& centre2, int axis) const {
    return std::min(bin_count - 1, static_cast<std::size_t>((centre2[axis] - origin[axis]) * scale[axis]));
  }
};

struct BinSet {
  Bins bins;
  void add(const BinSet& b) {
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t i = 0; i < bin_count; ++i) bins[a][i].add(b.bins[a][i]);
    }
  }
};

struct Split {
  int axis = -1;                                        ///< -1: none found
  std::size_t bin = 0;                                  ///< first bin of the right side
  float cost = std::numeric_limits<float>::infinity();  ///< sum over both sides of half area x count
};

Split best_split_along(const std::array<Bin, bin_count>& bins, int axis) {
  std::array<float, bin_count> right_cost{};
  Bin right;
  for (std::size_t i = bin_count - 1; i > 0; --i) {
    right.add(bins[i]);
    right_cost[i] = right.box.half_area() * static_cast<float>(right.count);
    if (right.count == 0) right_cost[i] = std::numeric_limits<float>::infinity();
  }
  Split best;
  Bin left;
  for (std::size_t i = 1; i < bin_count; ++i) {
    left.add(bins[i - 1]);
    if (left.count == 0) continue;
    const float cost = left.box.half_area() * static_cast<float>(left.count) + right_cost[i];
    if (cost < best.cost) best = {axis, i, cost};
  }
  return best;
}

class Builder {
 public:
  Builder(std::span<BvhPrimitive> primitives, std::span<BinaryNode> nodes)
      : primitives_(primitives), nodes_(nodes) {}

  /// Makes node `at` and those below it of the primitives [first, first + count).
  void build(std::size_t at, std::size_t first, std::size_t count, int depth) {
    if (count == 1) {
      nodes_[at] = {primitives_[first].box, 0, primitives_[first].index};
      return;
    }
    const std::size_t left_count = split(nodes_[at].box, primitives_.subspan(first, count), depth);
    const std::size_t second = at + 2 * left_count;
    nodes_[at].second = static_cast<std::uint32_t>(second);
    const auto build_side = [&](std::size_t side) {
      if (side == 0) build(at + 1, first, left_count, depth + 1);
      if (side == 1) build(second, first + left_count, count - left_count, depth + 1);
    };
    if (count > parallel_size) {
      parallel_for(2, 1, [&](std::size_t side, std::size_t /*end*/) { build_side(side); });
    } else {
      build_side(0);
      build_side(1);
    }
  }

 private:
  /// Measures the box of at least two primitives and parts them; returns how many come first.
  static std::size_t split(Box& box, std::span<BvhPrimitive> range, int depth) {
    const Bounds bounds = fold(range, Bounds{}, [](Bounds& b, std::span<const BvhPrimitive> part) {
      for (const BvhPrimitive& p : part) b.add(p);
    });
    box = bounds.box;
    const BinScale scale(bounds.centres);
    const bool is_free = depth + static_cast<int>(std::bit_width(range.size())) < most_levels;
    const Split best = is_free ? find_split(range, scale) : Split{};
    if (best.axis < 0) return split_by_count(range, bounds.centres);
    const auto middle = std::partition(range.begin(), range.end(), [&](const BvhPrimitive& p) {
      return scale.bin(p.centre2(), best.axis) < best.bin;
    });
    return static_cast<std::size_t>(middle - range.begin());
  }

  static Split find_split(std::span<const BvhPrimitive> range, const BinScale& scale) {
    const BinSet set = fold(range, BinSet{}, [&](BinSet& b, std::span<const BvhPrimitive> part) {
      for (const BvhPrimitive& p : part) {
        const vec3 c = p.centre2();
        for (int a = 0; a < 3; ++a) {
          Bin& bin = b.bins[static_cast<std::size_t>(a)][scale.bin(c, a)];
          bin.box.add(p.box);
          ++bin.count;
        }
      }
    });
    Split best;
    for (int a = 0; a < 3; ++a) {
      const Split s = best_split_along(set.bins[static_cast<std::size_t>(a)], a);
      if (s.cost < best.cost) best = s;
    }
    return best;
  }

  /// Halves by count along the widest axis of the centres; ties by index keep it deterministic.
  static std::size_t split_by_count(std::span<BvhPrimitive> range, const Box& centres) {
    const vec3 extent = centres.extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    const auto middle = range.begin() + static_cast<std::ptrdiff_t>(range.size() / 2);
    std::nth_element(range.begin(), middle, range.end(),
                     [axis](const BvhPrimitive& a, const BvhPrimitive& b) {
                       const float ca = a.centre2()[axis];
                       const float cb = b.centre2()[axis];
                       return ca != cb ? ca < cb : a.index < b.index;
                     });
    return range.size() / 2;
  }

  std::span<BvhPrimitive> primitives_;
  std::span<BinaryNode> nodes_;
};

}  // namespace

std::vector<BinaryNode> build_binary_bvh(std::span<BvhPrimitive> primitives) {
  std::vector<BinaryNode> nodes(2 * primitives.size() - 1);
  Builder(primitives, nodes).build(0, 0, primitives.size(), 0);
  return nodes;
}

}  // namespace facet
