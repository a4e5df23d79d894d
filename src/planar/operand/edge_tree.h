// Bounding boxes over the edges of a component: walk edges are spatially coherent, so halving their range is a good
// tree.
#pragma once

#include <atomic>
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
