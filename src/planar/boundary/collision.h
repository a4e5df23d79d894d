// Whether a position lies in the open set M = int P + Q or P + int Q, exactly: the operands overlap when Q, reflected,
// is moved there.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "exact/orient.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// Walk edges of P and Q that cross properly when Q, reflected, stands at a position: they prove that it lies in M.
using CrossingEdges = std::array<std::uint32_t, 2>;

/// The last `most` of these, the most recent first: what covered other positions often covers the next one.
template <std::size_t most>
class RecentEdges {
 public:
  /// The first ones for which `cross` holds.
  template <class Cross>
  std::optional<CrossingEdges> find(const Cross& cross) {
    for (std::size_t k = 0; k < count_; ++k)
      if (cross(edges_[k])) {
        const auto hit = edges_.begin() + static_cast<std::ptrdiff_t>(k);
        std::rotate(edges_.begin(), hit, hit + 1);
        return edges_[0];
      }
    return std::nullopt;
  }
  void remember(const CrossingEdges& edges) {
    count_ = std::min(count_ + 1, most);
    std::rotate(edges_.begin(), edges_.end() - 1, edges_.end());
    edges_[0] = edges;
  }

 private:
  std::array<CrossingEdges, most> edges_{};
  std::size_t count_ = 0;
};

struct CollisionCounts {
  std::uint64_t tests = 0, edge_pairs = 0, witnessed = 0;
  exact::RungCounts signs;
};

class Collision {
 public:
  /// `use_tree` off: every pair of edges is looked at (the reference).
  Collision(const Lattice& lattice, const Operand& p, const Operand& q, bool use_tree);

  /// Whether x itself lies in M. Touching is not overlapping.
  bool overlaps(const SegmentPosition& x);
  /// Whether the open face that touches x on the right of segment `on` (the one x lies on) lies in M: x is moved
  /// infinitely little to the right and then infinitely less ahead.
  bool overlaps_right_of(const SegmentPosition& x);

  /// Pairs of components without area are looked at too, as the interiors of the parallelograms of their edges.
  bool with_parallelograms = false;

  /// The walk edges of P and Q whose proper crossing answered the last question with yes, if that is how it was
  /// answered.
  std::optional<CrossingEdges> crossing_edges() const { return answered_by_; }

  const CollisionCounts& counts() const { return counts_; }

 private:
  struct Cone;

  bool test(const SegmentPosition& x);
  bool test_components(std::uint32_t p_component, std::uint32_t q_component);
  bool edges_cross(std::uint32_t e, std::uint32_t f);
  bool edges_overlap(std::uint32_t e, std::uint32_t f, bool parallelogram);
  bool contains_vertex(std::uint32_t holder, const EdgeTree& tree, std::uint32_t vertex);
  int height(std::uint32_t holder, std::uint32_t a, std::uint32_t v);
  bool cones_overlap(std::uint32_t i, bool whole_edge_p, std::uint32_t j, bool whole_edge_q);
  int side(std::uint32_t op, std::uint32_t edge, std::uint32_t vertex);
  int along(std::uint32_t op, std::uint32_t edge, std::uint32_t vertex, bool from_end);

  // Where the lattice's integers have 29 bits (Lattice::to_integers), the position is (x, y) / w exactly, w > 0, and
  // `ahead` the direction of the segment that it lies on. Parameters of cuts have 62 bits over 62, those of mediants
  // one more; w (x - pair sum) then 31 more.
  struct Whole {
    std::int64_t x, y;
  };
  struct Homogeneous {
    exact::i128 x, y;
    std::int64_t w;
    Whole ahead;
  };
  static_assert(63 + 31 + 30 + 1 <= 127, "a side: w (x - pair sum) times an edge, and the other product");
  std::int64_t integer(double v) const { return static_cast<std::int64_t>(v * lattice_.to_integers); }
  Whole whole(const Edge& e) const {
    const PlacedPoints& o = *lattice_.points[e.op];
    return {integer(o.x[e.to] - o.x[e.from]), integer(o.y[e.to] - o.y[e.from])};
  }
  Whole whole(Pair v) const {
    const PlacedPoints &p = *lattice_.points[0], &q = *lattice_.points[1];
    return {integer(p.x[v.p] + q.x[v.q]), integer(p.y[v.p] + q.y[v.q])};
  }
  Homogeneous homogeneous(const SegmentPosition& x) const;
  int cross(const Edge& d, const Edge& e) const;
  int dot(const Edge& d, const Edge& e) const;

  const Lattice& lattice_;
  std::array<const Operand*, 2> operands_;
  bool use_tree_;
  exact::Rung beyond_doubles_;
  const SegmentPosition* x_ = nullptr;
  bool integral_ = false;  ///< then the position is exactly this:
  Homogeneous at_{};
  bool displaced_ = false;
  CollisionCounts counts_;
  std::array<CrossingEdges, 4> witnesses_{};  ///< pairs of edges that crossed properly recently
  std::optional<CrossingEdges> answered_by_;
  std::size_t witness_count_ = 0, next_witness_ = 0;
};

}  // namespace dymsum::planar
