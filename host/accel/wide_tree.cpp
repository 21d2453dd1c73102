#include "accel/wide_tree.h"

#include <limits>

namespace facet {

WideTree::WideTree(std::span<const BinaryNode> binary) : binary_(binary), plans_(binary.size()) {
  // Children come after their parents.
  for (auto node = static_cast<std::uint32_t>(binary.size()); node-- > 0;) plans_[node] = plan(node);
}

WideTree::Plan WideTree::plan(std::uint32_t node) const {
  Plan result;
  if (binary_[node].is_leaf()) return result;
  const Plan& first = plans_[node + 1];
  const Plan& second = plans_[binary_[node].second];
  /// The best division of n children among the halves.
  const auto divide_best = [&](std::size_t n, float cost) {
    for (std::size_t k = 1; k < n; ++k) {
      const float divided = first.cost[k - 1] + second.cost[n - k - 1];
      if (!(divided < cost)) continue;
      cost = divided;
      result.of_first[n - 1] = static_cast<std::uint8_t>(k);
    }
    return cost;
  };
  // Any division of its own children will do where areas overflow.
  result.of_first[most - 1] = 1;
  result.cost[0] = divide_best(most, std::numeric_limits<float>::infinity()) + binary_[node].box.half_area();
  for (std::size_t n = 2; n < most; ++n) result.cost[n - 1] = divide_best(n, result.cost[n - 2]);
  return result;
}

Children WideTree::children_of(std::uint32_t node) const {
  Children children;
  divide(node, most, children);
  return children;
}

void WideTree::divide(std::uint32_t node, std::size_t n, Children& children) const {
  while (n > 1 && n < most && plans_[node].of_first[n - 1] == 0) --n;
  if (n == 1 || binary_[node].is_leaf()) return children.add(node);
  const std::size_t k = plans_[node].of_first[n - 1];
  divide(node + 1, k, children);
  divide(binary_[node].second, n - k, children);
}

}  // namespace facet
