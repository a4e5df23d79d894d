#include "planar/edge_tree.h"

#include <algorithm>
#include <cmath>

#include "planar/operand.h"

namespace dymsum::planar {
namespace {

std::uint32_t build(EdgeTree& tree, const Operand& o, std::uint32_t first, std::uint32_t last) {
  constexpr std::uint32_t kLeaf = 4;
  const std::uint32_t id = static_cast<std::uint32_t>(tree.nodes.size());
  tree.nodes.push_back({});
  EdgeTree::Node node{INFINITY, INFINITY, -INFINITY, -INFINITY, first, last, 0, 0};
  if (last - first > kLeaf) {
    const std::uint32_t middle = first + (last - first) / 2;
    node.left = build(tree, o, first, middle);
    node.right = build(tree, o, middle, last);
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
  build(tree, o, first, last);
  return tree;
}

}  // namespace dymsum::planar
