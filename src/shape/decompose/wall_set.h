// Walls to search: the nearest to a notch, those near a segment.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/decompose/wall.h"

namespace dymsum::shape {

/// A tree of the boxes of some walls.
class WallTree {
 public:
  WallTree(const std::vector<Wall>& walls, std::vector<std::uint32_t> of);

  const std::vector<std::uint32_t>& of() const { return of_; }

  /// visit(w) for walls whose boxes meet the cone and are not provably farther than the root of `most`, nearer boxes
  /// rather first; `most` may shrink meanwhile.
  template <class Visit>
  void near(const std::vector<Wall>& walls, const Notch& notch, const double& most, const Visit& visit) const {
    const auto search = [&](const auto& self, std::uint32_t n) -> void {
      const Node& node = nodes_[n];
      if (node.right == 0) {
        for (std::uint32_t k = node.first; k < node.last; ++k)
          if (least_square(walls[of_[k]].box, notch.m) <= most) visit(of_[k]);
        return;
      }
      std::uint32_t children[] = {n + 1, node.right};
      double least[] = {least_square(nodes_[n + 1].box, notch.m), least_square(nodes_[node.right].box, notch.m)};
      if (least[1] < least[0]) std::swap(children[0], children[1]), std::swap(least[0], least[1]);
      for (const int k : {0, 1})
        if (least[k] <= most && !notch.misses(nodes_[children[k]].box)) self(self, children[k]);
    };
    search(search, 0);
  }

  /// visit(w) for walls whose boxes meet this one.
  template <class Visit>
  void meeting(const std::vector<Wall>& walls, const Box& box, const Visit& visit) const {
    const auto search = [&](const auto& self, std::uint32_t n) -> void {
      const Node& node = nodes_[n];
      if (!node.box.meets(box)) return;
      if (node.right != 0) {
        self(self, n + 1);
        self(self, node.right);
        return;
      }
      for (std::uint32_t k = node.first; k < node.last; ++k)
        if (walls[of_[k]].box.meets(box)) visit(of_[k]);
    };
    search(search, 0);
  }

 private:
  struct Node {
    Box box;
    std::uint32_t first, last;
    std::uint32_t right;  ///< the left child follows its parent; 0: a leaf
  };
  void build(const std::vector<Wall>& walls, std::uint32_t first, std::uint32_t last);

  std::vector<std::uint32_t> of_;
  std::vector<Node> nodes_;
};

/// The edges of a region, and cuts that are added one by one.
class WallSet {
 public:
  /// Requires: at least one edge.
  explicit WallSet(std::vector<Wall> edges);
  /// Amortized O(log^2 n): the trees of cuts are as large as the digits of a binary counter are worth.
  void add(Wall cut);

  const Wall& operator[](std::uint32_t w) const { return walls_[w]; }

  template <class Visit>
  void near(const Notch& notch, const double& most, const Visit& visit) const {
    for (const WallTree& tree : trees_) tree.near(walls_, notch, most, visit);
    for (std::uint32_t w = loose_; w < walls_.size(); ++w)
      if (least_square(walls_[w].box, notch.m) <= most) visit(w);
  }
  template <class Visit>
  void edges_meeting(const Box& box, const Visit& visit) const {
    trees_.front().meeting(walls_, box, visit);
  }

 private:
  std::vector<Wall> walls_;
  std::vector<WallTree> trees_;  ///< of the edges; of cuts, each of more than the next
  std::uint32_t loose_;          ///< walls from here on are in no tree
};

}  // namespace dymsum::shape
