#include "accel/binary_bvh.h"

#include <algorithm>
#include <array>
#include <mutex>

#include "core/parallel.h"
#include "shared/records.h"

namespace facet {

namespace {

constexpr std::size_t most_bins = 24;
/// Levels of inner nodes at most: what cannot be halved by count in those that are left is not
/// split otherwise, so that no input makes a tree too deep for the kernels' stack.
constexpr int most_levels = shared::LARGEST_STACK_SIZE;
/// Nodes of more primitives are binned by all threads; subtrees of fewer are one task.
constexpr std::size_t parallel_primitives = 1U << 16U;

/// Of a range of primitives.
struct Bounds {
  Box4 box = empty_box4;
  Box4 centres = empty_box4;  ///< of twice the centres

  void add(const BvhPrimitive& p) {
    box.add(p.box());
    centres.add(p.centre2());
  }
  void add(const Bounds& b) {
    box.add(b.box);
    centres.add(b.centres);
  }
};

/// Folds ranges of the primitives into one result; in parallel where there are many. The result
/// does not depend on the order of folding, since it only takes minima, maxima and sums of
/// integers.
template <typename Result, typename Fold>
void fold(std::span<const BvhPrimitive> primitives, Result& result, const Fold& fold_range) {
  if (primitives.size() <= parallel_primitives) return fold_range(result, primitives);
  std::mutex mutex;
  const Result empty = result;
  parallel_for(primitives.size(), parallel_primitives / 4, [&](std::size_t begin, std::size_t end) {
    Result part = empty;
    fold_range(part, primitives.subspan(begin, end - begin));
    const std::scoped_lock lock(mutex);
    result.add(part);
  });
}

/// Which bin a centre falls into along each axis.
class BinScale {
 public:
  BinScale(const Box4& centres, std::size_t count) : origin_(centres.lower) {
    const Float4 extent = centres.upper - centres.lower;
    for (int a = 0; a < 3; ++a) {
      const float s = static_cast<float>(count) * 0.9999F / extent[a];
      if (extent[a] > 0 && extent[a] < infinity && s < infinity) scale_[a] = s;
    }
  }
  using Places [[gnu::vector_size(16)]] = int;
  /// The first bin along axes whose extent overflows.
  [[nodiscard]] Places places(const BvhPrimitive& p) const {
    return __builtin_convertvector(max((p.centre2() - origin_) * scale_, Float4{}), Places);
  }

 private:
  Float4 origin_;
  Float4 scale_{};  ///< 0 along axes without extent
};

struct Bin {
  Box4 box;
  std::uint32_t count;

  void add(const Bin& b) {
    box.add(b.box);
    count += b.count;
  }
  /// Half area x count; not of an empty bin.
  [[nodiscard]] float cost() const { return box.half_area() * static_cast<float>(count); }
};

using Bins = std::array<Bin, most_bins>;

struct BinSet {
  std::size_t count;  ///< used of each axis
  std::array<Bins, 3> bins;

  explicit BinSet(std::size_t bin_count) : count(bin_count) {
    for (Bins& row : bins) std::fill_n(row.begin(), count, Bin{empty_box4, 0});
  }

  void add(const BinSet& b) {
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t i = 0; i < count; ++i) bins[a][i].add(b.bins[a][i]);
    }
  }
};

struct Split {
  int axis = -1;          ///< -1: none found
  int place = 0;          ///< first bin of the right side
  float cost = infinity;  ///< sum over both sides of half area x count
};

/// The best division of an axis' bins, if it is better than `best`.
void find_best(std::span<const Bin> bins, int axis, Split& best) {
  std::array<float, most_bins> right_cost;
  Bin right{empty_box4, 0};
  for (std::size_t i = bins.size() - 1; i > 0; --i) {
    right.add(bins[i]);
    right_cost[i] = right.count > 0 ? right.cost() : infinity;
  }
  Bin left{empty_box4, 0};
  for (std::size_t i = 1; i < bins.size(); ++i) {
    left.add(bins[i - 1]);
    if (left.count == 0) continue;
    const float cost = left.cost() + right_cost[i];
    if (cost < best.cost) best = {axis, static_cast<int>(i), cost};
  }
}

/// The two parts of a range.
struct Parts {
  std::size_t first_count = 0;
  std::array<Bounds, 2> bounds;
};

}  // namespace

class BinaryBuilder {
 public:
  explicit BinaryBuilder(BinaryBvh& bvh) : bvh_(bvh) {}

  void build() {
    Bounds bounds;
    fold(bvh_.primitives_, bounds, [](Bounds& b, std::span<const BvhPrimitive> part) {
      for (const BvhPrimitive& p : part) b.add(p);
    });
    build({0, 0, bvh_.primitives_.size(), 0}, bounds);
  }

 private:
  /// A subtree of at least one primitive: a range of them, and as many inner nodes but one.
  struct Task {
    std::size_t inner;  ///< the first of its inner nodes
    std::size_t first;  ///< of its primitives
    std::size_t count;
    int depth;  ///< inner nodes above
  };

  /// Returns the subtree's root.
  BinaryBvh::Node build(const Task& task, const Bounds& bounds) {
    if (task.count == 1) return static_cast<BinaryBvh::Node>(task.first) | BinaryBvh::leaf;
    const Parts parts =
        part(std::span(bvh_.primitives_).subspan(task.first, task.count), bounds, task.depth);
    const std::size_t left = parts.first_count;
    const std::array<Task, 2> sides{
        {{task.inner + 1, task.first, left, task.depth + 1},
         {task.inner + left, task.first + left, task.count - left, task.depth + 1}}};
    std::array<BinaryBvh::Node, 2> roots{};
    const auto build_side = [&](std::size_t side, std::size_t /*end*/) {
      roots[side] = build(sides[side], parts.bounds[side]);
    };
    if (task.count > parallel_primitives) {
      parallel_for(2, 1, build_side);
    } else {
      build_side(0, 1);
      build_side(1, 2);
    }
    bvh_.inner_[task.inner] = {to_vec3(bounds.box.lower), to_vec3(bounds.box.upper), roots[0],
                               roots[1]};
    return static_cast<BinaryBvh::Node>(task.inner);
  }

  /// Parts at least two primitives.
  static Parts part(std::span<BvhPrimitive> range, const Bounds& bounds, int depth) {
    if (range.size() == 2) return measured(range, 1);
    // All but one of them may come to lie on one side.
    const auto halvings = static_cast<int>(std::bit_width(range.size() - 2));
    if (depth + 1 + halvings <= most_levels) {
      const std::size_t bins = std::min(most_bins, 4 + range.size() / 8);
      const BinScale scale(bounds.centres, bins);
      const Split split = find_split(range, scale, bins);
      if (split.axis >= 0) return part_by_bins(range, scale, split);
    }
    return part_by_count(range, bounds.centres);
  }

  static Split find_split(std::span<const BvhPrimitive> range, const BinScale& scale,
                          std::size_t bins) {
    BinSet set(bins);
    fold(range, set, [&](BinSet& b, std::span<const BvhPrimitive> part) {
      for (const BvhPrimitive& p : part) {
        const BinScale::Places places = scale.places(p);
        for (int a = 0; a < 3; ++a) {
          Bin& bin = b.bins[static_cast<std::size_t>(a)][static_cast<std::size_t>(places[a])];
          bin.box.add(p.box());
          ++bin.count;
        }
      }
    });
    Split best;
    for (int a = 0; a < 3; ++a)
      find_best(std::span(set.bins[static_cast<std::size_t>(a)]).first(bins), a, best);
    return best;
  }

  /// What is left of the split comes first. No branch depends on the side, which nobody could
  /// predict.
  static Parts part_by_bins(std::span<BvhPrimitive> range, const BinScale& scale,
                            const Split& split) {
    Parts parts;
    for (std::size_t i = 0; i < range.size(); ++i) {
      const BvhPrimitive p = range[i];
      const std::size_t side = scale.places(p)[split.axis] < split.place ? 0 : 1;
      parts.bounds[side].add(p);
      range[i] = range[parts.first_count];
      range[parts.first_count] = p;
      parts.first_count += 1 - side;
    }
    return parts;
  }

  /// Halves by count along the widest axis of the centres; ties by index keep it deterministic.
  static Parts part_by_count(std::span<BvhPrimitive> range, const Box4& centres) {
    const Float4 extent = centres.upper - centres.lower;
    const int axis =
        extent[0] >= extent[1] && extent[0] >= extent[2] ? 0 : (extent[1] >= extent[2] ? 1 : 2);
    const auto middle = range.begin() + static_cast<std::ptrdiff_t>(range.size() / 2);
    std::nth_element(range.begin(), middle, range.end(),
                     [axis](const BvhPrimitive& a, const BvhPrimitive& b) {
                       const float ca = a.centre2()[axis];
                       const float cb = b.centre2()[axis];
                       return ca != cb ? ca < cb : a.index() < b.index();
                     });
    return measured(range, range.size() / 2);
  }

  static Parts measured(std::span<const BvhPrimitive> range, std::size_t first_count) {
    Parts parts;
    parts.first_count = first_count;
    for (std::size_t i = 0; i < range.size(); ++i)
      parts.bounds[i < first_count ? 0 : 1].add(range[i]);
    return parts;
  }

  BinaryBvh& bvh_;
};

BinaryBvh::BinaryBvh(UnfilledVector<BvhPrimitive> primitives)
    : primitives_(std::move(primitives)), inner_(primitives_.size() - 1) {
  BinaryBuilder(*this).build();
}

}  // namespace facet
