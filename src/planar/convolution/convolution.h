// The convolutions of two operands: which edge + vertex sums can lie on the boundary of the sum, found by merging edges
// sorted by direction. Definition and proofs: docs/design/planar-sum.md.
#pragma once

#include <array>
#include <cstdint>
#include <forward_list>
#include <functional>
#include <span>
#include <vector>

#include "base/scratch.h"
#include "dymsum/planar_sum.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// The edges of the other operand's component that a vertex meets: positions lo, lo + 1, ... of `list`, modulo its
/// length; they form the segments base, base + 1, ...
struct Turn {
  std::uint32_t list = 0, lo = 0, count = 0, base = 0;
};

/// Whether a hole of one operand does not show in the sum with a component of the other one.
using HoleFilled =
    std::function<bool(const Operand& holed, const Loop& hole, const Operand& other, const Component& component)>;
/// No hole stays filled in the convolution of all positive scales.
inline bool never_filled(const Operand&, const Loop&, const Operand&, const Component&) { return false; }

/// The reduced convolution as ranges: segment ids are 0 .. size - 1, side 0 first; (edge, vertex) <-> id in O(1).
class ReducedConvolution {
 public:
  ReducedConvolution(const Lattice& lattice, const Operand& p, const Operand& q, Scratch* memory = nullptr);
  /// Leaves out the holes that `filled` decides, instead of those that are filled where both operands stand.
  ReducedConvolution(const Lattice& lattice, const Operand& p, const Operand& q, HoleFilled filled,
                     Scratch* memory = nullptr);

  std::uint32_t size() const { return size_; }
  /// The id of a segment, or kNoRank if it is not in the reduced convolution. O(1).
  std::uint32_t find(std::uint32_t side, std::uint32_t edge, std::uint32_t vertex) const;
  /// The segment that continues `s` at its end, or kNoRank. Unique.
  std::uint32_t next(const WalkSegment& s) const;
  std::uint32_t prev(const WalkSegment& s) const;

  /// next() of every segment, in the order of ids. Requires: next has size() entries.
  void fill_next(std::span<std::uint32_t> next) const;

  /// Calls f(side, vertex, edges, lo, count) for every vertex that has segments, in the order of ids: with the edges at
  /// positions lo, lo + 1, ... of the cyclic list.
  template <class F>
  void for_each_turn(F&& f) const {
    for (std::uint32_t side = 0; side < 2; ++side)
      for (const std::uint32_t at : used_[side]) {
        const Turn& t = turns_[side][at];
        f(side, vertex_of(side, at), std::span<const std::uint32_t>(lists_[t.list]->edges), t.lo, t.count);
      }
  }
  /// Calls f(WalkSegment) for every segment in the order of ids.
  template <class F>
  void for_each(F&& f) const {
    for_each_turn([&](std::uint32_t side, std::uint32_t v, std::span<const std::uint32_t> edges, std::uint32_t lo,
                      std::uint32_t count) {
      for (std::uint32_t k = 0, at = lo; k < count; ++k, at = at + 1 == edges.size() ? 0 : at + 1)
        f(WalkSegment{side, edges[at], v});
    });
  }

  std::size_t filled_holes() const { return filled_holes_; }
  /// How many edges of P have one of Q in the same direction.
  std::size_t parallel_edges() const { return parallel_edges_; }

 protected:  // for who follows operands that change
  // The id of the segment of an edge that belongs to the turn's component, or kNoRank.
  std::uint32_t id(const Turn& t, std::uint32_t edge) const {
    if (t.count == 0) return kNoRank;
    const DirectionList& list = *lists_[t.list];
    if (edge < list.base || edge - list.base >= list.rank.size()) return kNoRank;
    const std::uint32_t rank = list.rank[edge - list.base];
    if (rank == kNoRank) return kNoRank;
    const std::uint32_t n = static_cast<std::uint32_t>(list.edges.size());
    const std::uint32_t k = rank >= t.lo ? rank - t.lo : rank + n - t.lo;
    return k < t.count ? t.base + k : kNoRank;
  }
  std::uint32_t vertex_of(std::uint32_t side, std::uint32_t turn) const {
    return columns_[side] == 1 ? turn : turn / columns_[side];
  }

 private:
  struct Edges;
  // Positions of one list's directions in another one, for outer loops and for holes; empty until requested.
  struct Bounds {
    explicit Bounds(Scratch* memory) : of_outer(memory), of_hole(memory) {}
    Array<std::uint32_t> of_outer, of_hole;
  };
  Edges edges_of(std::uint32_t op, std::uint32_t component, std::uint32_t other_component);
  void add_pair(std::uint32_t cp, std::uint32_t cq, Scratch* memory);
  void add_turns(std::uint32_t side, const Edges& edges, const Edges& vertices, Bounds& bounds);

  const Lattice& lattice_;  // while it is made
  HoleFilled filled_;

 protected:
  std::array<const Operand*, 2> operands_;
  std::array<std::uint32_t, 2> columns_{};    ///< components of the edge side
  std::array<Array<Turn>, 2> turns_;          ///< [side][vertex * columns + component of the edge side]
  std::array<Array<std::uint32_t>, 2> used_;  ///< the turns that have segments
  Array<const DirectionList*> lists_;
  std::forward_list<DirectionList> own_lists_;  ///< without some of a component's holes
  std::uint32_t size_ = 0;
  std::size_t filled_holes_ = 0, parallel_edges_ = 0;
};

/// Whether a hole of one component cannot hold the other component, by bounding boxes, exactly: then it does not show
/// in the sum.
bool hole_is_filled(const Lattice& lattice, const Operand& holed, const Loop& hole, const Operand& other,
                    const Component& component);

// The kinetic convolution: every vertex with the edges of the other operand that it meets while it turns the short way,
// reversed where it turns clockwise. Its winding number about x is the Euler characteristic of P and x - Q in common.

/// The edges of an operand's component that a walk vertex of the other operand meets in its short turn: `count` of
/// `edges` (a cyclic list sorted by direction) from `lo` on. Side 0: edges of P + vertex of Q.
struct KineticTurn {
  std::uint32_t side = 0, vertex = 0;
  const std::vector<std::uint32_t>* edges = nullptr;
  std::uint32_t lo = 0, count = 0;
  int sign = 1;  ///< 1: a counter-clockwise turn; -1: a clockwise one, the edges are traversed reversed
};

/// Calls f for every vertex (its turn may be empty) of every pair of components of which at least one is
/// two-dimensional, without the holes that the pair fills (hole_is_filled). Turns are half-open as if the directions of
/// Q were turned counter-clockwise by an infinitesimal angle: (in, out] for vertices of Q, [in, out) for vertices of P,
/// and (out, in], [out, in) where they turn clockwise. Hence every pair of vertices starts as many segments as it ends.
/// Cost: O(n log n + n log m) and the calls, for n vertices of both and m edges of the larger component, per pair of
/// components.
void for_each_kinetic_turn(const Lattice& lattice, const Operand& p, const Operand& q,
                           const std::function<void(const KineticTurn&)>& f);

/// A segment of the kinetic convolution in the direction of its edge: crossing it from right to left changes the
/// winding number by `sign`.
struct KineticSegment {
  WalkSegment walk;
  int sign = 1;
};

std::vector<KineticSegment> kinetic_convolution(const Lattice& lattice, const Operand& p, const Operand& q);

// What pairs of edges add without any area in either operand: in the closed sum parallelograms.

/// Whether there are any: in open sums they are none.
bool makes_parallelograms(Semantics semantics, const Operand& p, const Operand& q);

/// All that bounds closed sums of components without area, and is a piece of them, wherever the operands stand: each
/// edge of one with each vertex of the other, once where a polyline is walked there and back; and sums of two points.
struct SumsWithoutArea {
  std::vector<WalkSegment> segments;
  std::vector<WalkPair> points;
};
SumsWithoutArea sums_without_area(const Operand& p, const Operand& q);

/// Two sides of the parallelogram of every pair of edges of two components without area that turns left; as polylines
/// are walked there and back, those of the backward edges close it, counter-clockwise. O(n m) for n and m such edges.
std::vector<WalkSegment> parallelogram_sides(const Lattice& lattice, const Operand& p, const Operand& q);

}  // namespace dymsum::planar
