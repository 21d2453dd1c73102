#include "accel/wide_tree.h"

#include <array>

#include "core/parallel.h"

namespace facet {

namespace {

/// Subtrees of fewer inner nodes are one task.
constexpr std::uint32_t parallel_inner_nodes = 1U << 15U;

}  // namespace

WideTree::WideTree(const BinaryBvh& binary) : binary_(binary), plans_(binary.inner_count()) {
  plan(binary.root(), static_cast<BinaryBvh::Node>(binary.inner_count()));
}

WideTree::Costs WideTree::plan(BinaryBvh::Node node, BinaryBvh::Node end) {
  if (BinaryBvh::is_leaf(node)) return {};
  const std::array<BinaryBvh::Node, 2> halves{binary_.first(node), binary_.second(node)};
  const std::array<BinaryBvh::Node, 2> ends{BinaryBvh::is_leaf(halves[1]) ? end : halves[1], end};
  std::array<Costs, 2> costs;
  const auto plan_half = [&](std::size_t h, std::size_t /*end*/) {
    costs[h] = plan(halves[h], ends[h]);
  };
  if (end - node > parallel_inner_nodes) {
    parallel_for(2, 1, plan_half);
  } else {
    plan_half(0, 1);
    plan_half(1, 2);
  }
  return plan_node(node, costs[0], costs[1]);
}

WideTree::Costs WideTree::plan_node(BinaryBvh::Node node, const Costs& first, const Costs& second) {
  Plan& plan = plans_[node];
  /// What n children cost of which the first half gets k.
  const auto divided = [&](std::size_t n, std::size_t k) {
    const Cost& a = first[k - 1];
    const Cost& b = second[n - k - 1];
    return Cost{a.area + b.area, a.nodes + b.nodes};
  };
  /// The best division of n children, or `cost` where none is better.
  const auto best_division = [&](std::size_t n, Cost cost) {
    for (std::size_t k = 1; k < n; ++k) {
      const Cost c = divided(n, k);
      if (!(c.area < cost.area)) continue;
      cost = c;
      plan.of_first[n - 1] = static_cast<std::uint8_t>(k);
    }
    return cost;
  };
  // Any division of its own children will do where areas overflow.
  plan.of_first[most - 1] = 1;
  const Cost below = best_division(most, divided(most, 1));
  plan.node_count = below.nodes + 1;
  Costs costs;
  costs[0] = {below.area + binary_.box(node).half_area(), plan.node_count};
  for (std::size_t n = 2; n < most; ++n) costs[n - 1] = best_division(n, costs[n - 2]);
  return costs;
}

Children WideTree::children_of(BinaryBvh::Node node) const {
  Children children;
  divide(node, most, children);
  return children;
}

void WideTree::divide(BinaryBvh::Node node, std::size_t n, Children& children) const {
  if (BinaryBvh::is_leaf(node)) return children.add(node);
  while (n > 1 && n < most && plans_[node].of_first[n - 1] == 0) --n;
  if (n == 1) return children.add(node);
  const std::size_t k = plans_[node].of_first[n - 1];
  divide(binary_.first(node), k, children);
  divide(binary_.second(node), n - k, children);
}

}  // namespace facet
