#include "planar/operand/edge_tree.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "planar/operand/operand.h"

namespace dymsum::planar {
namespace {

constexpr std::uint32_t kLeaf = 4;

std::size_t nodes_over(std::uint32_t n) { return n > kLeaf ? 1 + nodes_over(n / 2) + nodes_over(n - n / 2) : 1; }

std::uint32_t build(EdgeTree& tree, const Operand& o, std::uint32_t first, std::uint32_t last) {
  const std::uint32_t id = static_cast<std::uint32_t>(tree.nodes.size());
  tree.nodes.push_back({});
  EdgeTree::Node node{INFINITY, INFINITY, -INFINITY, -INFINITY, first, last, 0, 0};
  if (last - first > kLeaf) {
    const std::uint32_t midpoint = first + (last - first) / 2;
    node.left = build(tree, o, first, midpoint);
    node.right = build(tree, o, midpoint, last);
    const EdgeTree::Node &a = tree.nodes[node.left], &b = tree.nodes[node.right];
    node.x0 = std::min(a.x0, b.x0);
    node.y0 = std::min(a.y0, b.y0);
    node.x1 = std::max(a.x1, b.x1);
    node.y1 = std::max(a.y1, b.y1);
  } else {
    for (std::uint32_t i = first; i < last; ++i)
      for (const std::uint32_t v : {i, o.next[i]}) {
        node.x0 = std::min(node.x0, o.x[v]);
        node.y0 = std::min(node.y0, o.y[v]);
        node.x1 = std::max(node.x1, o.x[v]);
        node.y1 = std::max(node.y1, o.y[v]);
      }
  }
  tree.nodes[id] = node;
  return id;
}

}  // namespace

EdgeTree make_edge_tree(const Operand& o, std::uint32_t first, std::uint32_t last) {
  EdgeTree tree;
  tree.nodes.reserve(nodes_over(last - first));
  build(tree, o, first, last);
  return tree;
}

const std::vector<EdgeTree>& EdgeTrees::of(const Operand& o) const {
  if (const auto* made = made_.load(std::memory_order_acquire); made != nullptr) return *made;
  auto trees = std::make_unique<std::vector<EdgeTree>>();
  for (const Component& c : o.components) trees->push_back(make_edge_tree(o, c.first, c.last));
  const std::vector<EdgeTree>* first = nullptr;  // another thread's, perhaps
  return made_.compare_exchange_strong(first, trees.get(), std::memory_order_acq_rel) ? *trees.release() : *first;
}

}  // namespace dymsum::planar
