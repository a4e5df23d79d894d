// Walls to search: the nearest to a notch, those near a segment; and the rings that they are edges of.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/decomposition.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "exact/interval.h"

namespace dymsum::shape {

// The rings of a region without polylines and points, by the indices of their vertices.

struct RingTable {
  std::vector<Point> at;
  std::vector<std::uint32_t> next, previous, ring;
  std::vector<std::uint32_t> first;  ///< per ring, and the number of vertices after the last
  std::vector<std::uint32_t> part;   ///< per ring
  std::vector<bool> is_hole;         ///< per ring
  std::vector<std::uint32_t> rank;   ///< of vertices, for ties: see canonical_ranks

  bool is_reflex(std::uint32_t v) const;
  /// Rings by the least ranks of their vertices.
  std::vector<std::uint32_t> ranked_rings() const;

  std::uint32_t ring_count() const { return std::uint32_t(part.size()); }
};
/// Requires: ranks for the vertices of the region, different ones; none for those in an edge.
RingTable ring_table(const Region& region, const std::vector<std::optional<std::uint32_t>>& rank);

RationalPoint rational_point(Point p);

// What a cut can end at: edges of the region and cuts made before; and the nearest point of one in the cone of a notch.

/// Double bounds of an exact number: between the neighbours of the double nearest to it.
exact::Interval bounds_of(const Rational& v);

struct Box {
  double x0, y0, x1, y1;
  bool meets(const Box& b) const { return x0 <= b.x1 && b.x0 <= x1 && y0 <= b.y1 && b.y0 <= y1; }
  void add(const Box& b) {
    x0 = std::min(x0, b.x0), y0 = std::min(y0, b.y0), x1 = std::max(x1, b.x1), y1 = std::max(y1, b.y1);
  }
};

/// No more than the square of the distance of p from the box.
double least_square(const Box& box, Point p);

/// A closed segment from a plain point: an edge or a cut.
struct Wall {
  Cut::End kind;        ///< edge or cut
  std::uint32_t index;  ///< of the edge or cut
  std::uint32_t ring;   ///< of its first end
  Point a, b;           ///< of a cut the double nearest to its end
  exact::Interval bx, by;
  std::optional<RationalPoint> to;  ///< the exact end of a cut
  Box box;

  RationalPoint from() const;
  RationalPoint end() const;
};
Wall edge_wall(Point a, Point b, std::uint32_t index, std::uint32_t ring);
Wall cut_wall(Point a, const RationalPoint& to, std::uint32_t index, std::uint32_t ring);

/// The sign of (b - a) x (p - a) for the second end p of the wall. Exact.
int side_of_end(Point a, Point b, const Wall& wall);
/// The sign of (b - a) x (p - a) for the line through a wall. Exact.
int side_of(const Wall& wall, Point p);

/// The nearest point of a wall in a cone.
struct Nearest {
  Rational square, t;  ///< of the distance; along the wall from 0 to 1
  RationalPoint at;
};

/// A reflex vertex, and the directions that resolve it: not to the right of m -> next, not to the left of m ->
/// previous.
struct Notch {
  Point m, previous, next;

  bool admits(Point p) const;
  bool admits_end(const Wall& wall) const;
  /// Whether doubles prove that the cone and the box are apart.
  bool misses(const Box& box) const;

  /// Bounds of the square of the distance of the wall's part in the cone. `none`: it has no such part. `proved`: it
  /// has, and m does not lie on it.
  struct Estimate {
    bool none = false, proved = false;
    exact::Interval square;
  };
  Estimate estimate(const Wall& wall) const;
  /// Nothing where the wall has no part in the cone, or only m. Exact.
  std::optional<Nearest> nearest(const Wall& wall) const;
};

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
