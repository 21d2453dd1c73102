#include "reference/tree.h"

#include <algorithm>
#include <numeric>

namespace facet::reference {

namespace {

constexpr std::uint32_t leaf_size = 3;
/// Beyond this depth nodes are halved by number, so that the limit of 96 holds for 2^32 primitives.
constexpr std::size_t heuristic_depth = 60;

class Builder {
 public:
  explicit Builder(std::span<const Box> boxes) : boxes_(boxes), right_areas_(boxes.size()) {
    tree_.order.resize(boxes.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0U);
  }

  Tree build() {
    if (!boxes_.empty()) add_node(0, static_cast<std::uint32_t>(boxes_.size()), 0);
    return std::move(tree_);
  }

 private:
  [[nodiscard]] float centre(std::uint32_t primitive, int axis) const {
    return 0.5F * boxes_[primitive].lower[axis] + 0.5F * boxes_[primitive].upper[axis];
  }

  void add_node(std::uint32_t begin, std::uint32_t end, std::size_t depth) {
    const std::size_t index = tree_.nodes.size();
    tree_.nodes.emplace_back();
    Box bounds;
    Box centres;
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t p = tree_.order[i];
      bounds.add(boxes_[p]);
      centres.add(vec3(centre(p, 0), centre(p, 1), centre(p, 2)));
    }
    tree_.nodes[index].box = bounds;
    const std::uint32_t count = end - begin;
    if (count <= leaf_size) {
      tree_.nodes[index].first_or_right = begin;
      tree_.nodes[index].count = count;
      return;
    }
    const vec3 extent = centres.extent();
    int axis = extent.x >= extent.y ? 0 : 1;
    if (extent.z > extent[axis]) axis = 2;
    const auto first = tree_.order.begin() + begin;
    std::sort(first, first + count, [&](std::uint32_t a, std::uint32_t b) {
      const float ca = centre(a, axis);
      const float cb = centre(b, axis);
      return ca != cb ? ca < cb : a < b;
    });
    const std::uint32_t middle =
        depth < heuristic_depth ? best_split(begin, end) : begin + count / 2;
    add_node(begin, middle, depth + 1);
    tree_.nodes[index].first_or_right = static_cast<std::uint32_t>(tree_.nodes.size());
    add_node(middle, end, depth + 1);
  }

  /// Where the sum of (area of a side times its number of primitives) is least.
  std::uint32_t best_split(std::uint32_t begin, std::uint32_t end) {
    Box right;
    for (std::uint32_t i = end; i-- > begin + 1;) {
      right.add(boxes_[tree_.order[i]]);
      right_areas_[i] = right.half_area();
    }
    Box left;
    std::uint32_t best = begin + (end - begin) / 2;
    float least = std::numeric_limits<float>::infinity();
    for (std::uint32_t i = begin + 1; i < end; ++i) {
      left.add(boxes_[tree_.order[i - 1]]);
      const float cost = left.half_area() * static_cast<float>(i - begin) +
                         right_areas_[i] * static_cast<float>(end - i);
      if (cost < least) {
        least = cost;
        best = i;
      }
    }
    return best;
  }

  std::span<const Box> boxes_;
  std::vector<float> right_areas_;
  Tree tree_;
};

}  // namespace

Tree build_tree(std::span<const Box> boxes) { return Builder(boxes).build(); }

}  // namespace facet::reference
