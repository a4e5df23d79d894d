// The edges of one operand: their vectors and exact signs, their order by direction, a tree of their boxes.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/memory_budget.h"
#include "exact/int.h"
#include "exact/orient.h"
#include "exact/rounding_bound.h"
#include "planar/operand/fraction_lattice.h"
#include "planar/operand/lattice.h"
#include "planar/operand/make_lattice.h"

namespace dymsum::planar {

// The edges of one operand by themselves: vectors and exact signs that need no lattice with another operand.

/// Edges between source vertices that are neither scaled nor turned. Signs are of the points as given, in integers of
/// at most 53 bits where these hold them, else by the exact predicates of doubles, or those of fractions.
class OwnEdges {
 public:
  explicit OwnEdges(const PlacedPoints& points)
      : input_(points.input.data()),
        x_(points.x.data()),
        y_(points.y.data()),
        fractions_(points.fractions.get()),
        unit_(points.unit),
        per_unit_(power_of_two(-points.unit)) {
    const int shift = points.unit - points.exponent;
    if (fractions_ == nullptr && points.bits(points.exponent) <= 53 && std::abs(shift) <= 1000)
      per_double_ = power_of_two(shift);
  }

  /// Each component rounded once, in the units of the points; zero only where it is.
  Point vector(std::uint32_t from, std::uint32_t to) const {
    if (fractions_ != nullptr) return fractions_->vector(from, to, unit_);
    const Point d = direction(from, to);
    return {with_sign_of(d.x, d.x * per_unit_), with_sign_of(d.y, d.y * per_unit_)};
  }
  /// The direction in input units, or those of the edge's own fractions: no rounding underflows.
  Point direction(std::uint32_t from, std::uint32_t to) const {
    if (fractions_ != nullptr) return fractions_->direction(from, to);
    const Point a = input_[from], b = input_[to];
    return {b.x - a.x, b.y - a.y};
  }
  /// The sign of d x e, of d . e for edge vectors.
  int cross(const Edge& d, const Edge& e) const {
    if (fractions_ != nullptr) return fractions_->cross(d, e);
    if (per_double_ == 0) return exact::cross_sign(input_[d.from], input_[d.to], input_[e.from], input_[e.to]);
    return exact::sign_of_cross(along(x_, d), along(y_, d), along(x_, e), along(y_, e));
  }
  int dot(const Edge& d, const Edge& e) const {
    if (fractions_ != nullptr) return fractions_->dot(d, e);
    if (per_double_ == 0) return exact::dot_sign(input_[d.from], input_[d.to], input_[e.from], input_[e.to]);
    return exact::sign_of_dot(along(x_, d), along(y_, d), along(x_, e), along(y_, e));
  }

 private:
  exact::Int<54> along(const double* coordinates, const Edge& e) const {
    return integer(coordinates[e.to]) - integer(coordinates[e.from]);
  }
  // The integer has at most 53 bits: no step of making the double was rounded.
  exact::Int<53> integer(double coordinate) const {
    return exact::Int<53>::from_int64(static_cast<std::int64_t>(coordinate * per_double_));
  }

  const Point* input_;
  const double *x_, *y_;
  const FractionPoints* fractions_;
  int unit_;
  double per_unit_, per_double_ = 0;
};

// Bounding boxes over the edges of a component: walk edges are spatially coherent, so halving their range is a good
// tree.

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

// Edges in the order of their directions.

/// Walk edges of one component (or of its outer loop, or without its filled holes) by direction, counter-clockwise from
/// +x.
struct DirectionList {
  DirectionList() = default;
  explicit DirectionList(const OwnMemory& memory) : edges(memory), keys(memory), rank(memory), next(memory) {}

  OwnArray<std::uint32_t> edges;
  OwnArray<double> keys;         ///< pseudo-angles in [0, 4]
  OwnArray<std::uint32_t> rank;  ///< walk edge - base -> position in edges, or kNoRank
  OwnArray<std::uint32_t> next;  ///< position of an edge -> position of the edge after it in its walk
  std::uint32_t base = 0;
};
inline constexpr std::uint32_t kNoRank = 0xffffffff;

/// 0 for directions in [0, pi), 1 for the others.
inline int half_plane(double x, double y) { return y > 0 || (y == 0 && x > 0) ? 0 : 1; }

/// Monotone in the angle, in [0, 4].
inline double pseudo_angle(double x, double y) {
  const double c = x / (std::abs(x) + std::abs(y));
  return half_plane(x, y) == 0 ? 1 - c : 3 + c;
}
/// The error of the pseudo-angle of a vector whose components carry three roundings each, of a scaled one: a change of
/// x by d of itself changes x / (|x| + |y|) by |x y| / (|x| + |y|)^2 d <= d / 4, so components make 2 * 3 / 4, sum and
/// quotient 1 each, and the final sum, which is less than 4, makes 2. Two of them are compared, and the bound's own sum
/// makes 2.
inline constexpr double kAngleError = exact::rounding_bound(2 * 6 + 2, 32);

/// The order of directions: by half plane (angles [0, pi) first), then counter-clockwise. -1, 0, 1.
int compare_directions(const Lattice& lattice, const Edge& d, const Edge& e);

/// The same with the pseudo-angles as a filter in front.
inline int compare_directions(const Lattice& lattice, double key_d, const Edge& d, double key_e, const Edge& e) {
  if (key_d < key_e - kAngleError) return -1;
  if (key_d > key_e + kAngleError) return 1;
  return compare_directions(lattice, d, e);
}

struct Operand;
struct Component;

/// Ranks and followers of `edges`. Requires: base and the size of rank.
void number(DirectionList& list, const Operand& o);

/// All edges of a component, those with equal directions in the order of the walk; in the operand's memory.
DirectionList sort_by_direction(const OwnEdges& edges, const Operand& o, const Component& c);

/// Those of the loops l, counted through the operand, with keep[l] set, in the memory of `list`.
DirectionList sublist(const DirectionList& all, const Operand& o, const Component& c,
                      const std::vector<std::uint8_t>& keep, DirectionList list = {});

}  // namespace dymsum::planar
