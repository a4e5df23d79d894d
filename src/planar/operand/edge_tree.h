// Bounding boxes over the edges of a component: walk edges are spatially coherent, so halving their range is a good
// tree.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dymsum::planar {

struct Operand;

struct EdgeTree {
  struct Node {
    double x0, y0, x1, y1;
    std::uint32_t first, last;  ///< walk edges
    std::uint32_t left, right;  ///< 0: a leaf
  };
  std::vector<Node> nodes;  ///< the root first
};

/// Whether leaves(a, b) says true for a pair of leaves below node i of one tree and node j of another one; nothing is
/// looked at after that, nor below nodes for which apart(a, b) does. The longer of two ranges of edges is halved first.
template <class Apart, class Leaves>
bool any_pair_of_leaves(const std::vector<EdgeTree::Node>& p, std::uint32_t i, const std::vector<EdgeTree::Node>& q,
                        std::uint32_t j, const Apart& apart, const Leaves& leaves) {
  std::array<std::uint32_t, 128> stack_p, stack_q;  // two per level, of at most 2 x 32 levels; not cleared
  std::size_t top = 0;
  const auto push = [&](std::uint32_t k, std::uint32_t l) {
    stack_p[top] = k;
    stack_q[top++] = l;
  };
  push(i, j);
  while (top > 0) {
    const std::uint32_t k = stack_p[--top], l = stack_q[top];
    const EdgeTree::Node &a = p[k], &b = q[l];
    if (apart(a, b)) continue;
    if (a.left == 0 && b.left == 0) {
      if (leaves(a, b)) return true;
    } else if (b.left == 0 || (a.left != 0 && a.last - a.first >= b.last - b.first)) {
      push(a.left, l);
      push(a.right, l);
    } else {
      push(k, b.left);
      push(k, b.right);
    }
  }
  return false;
}

/// The trees of all components of an operand, made when first requested: small sums rarely do. Copies make their own.
/// Thread-safe.
class EdgeTrees {
 public:
  EdgeTrees() = default;
  EdgeTrees(const EdgeTrees&) {}
  EdgeTrees& operator=(const EdgeTrees&) {
    delete made_.exchange(nullptr);
    return *this;
  }
  ~EdgeTrees() { delete made_.load(); }
  const std::vector<EdgeTree>& of(const Operand& o) const;

 private:
  mutable std::atomic<const std::vector<EdgeTree>*> made_ = nullptr;
};

EdgeTree make_edge_tree(const Operand& o, std::uint32_t first, std::uint32_t last);

}  // namespace dymsum::planar
