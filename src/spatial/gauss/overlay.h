// The overlay of two Gauss maps: which vertex of the other solid is extreme for every face, and which arcs of edges
// cross. It is the combinatorics of the sum of convex solids, and what a motion updates. docs/design/convex-motion.md.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "exact/rounding_bound.h"
#include "spatial/gauss/arc_crossings.h"
#include "spatial/gauss/polytope.h"
#include "spatial/gauss/signs.h"

namespace dymsum::exact {

// Making up for a single rounding.

/// Factors of a positive number x = fl(y): fl(x kUp) >= y and fl(x kDown) <= y, as either moves x by a unit in its last
/// place at least.
inline constexpr double kUp = 1 + 2 * kRoundoff, kDown = 1 - 2 * kRoundoff;

}  // namespace dymsum::exact

namespace dymsum::spatial {

// What a long move finds while it walks along all arcs of one operand, kept from move to move.

struct LeapScratch {
  /// An arc of the walker that is walked, ...
  struct Walk {
    Vec3 row;                    // of the face to reach, where there is one
    std::array<float, 3> along;  // its edge's direction, mapped
    HalfEdge h;                  // the direction in which it is walked
    std::uint32_t v;             // the cell at hand
    std::uint32_t goal;          // the face to reach, or the last cell
    std::uint32_t after;         // the crossing found after which the next one is put, in the order of the edge's arc
  };
  /// ... a crossing found, in lists along the arcs of both operands, ...
  struct Found {
    std::uint32_t e;
    HalfEdge over;
    std::uint32_t next, next_across, id;
  };
  /// ... and an arc of the other operand: the first of its crossings in any order, the cells of its ends.
  struct Across {
    std::uint32_t first, count, begin, end;
  };
  std::vector<Walk> walks;
  std::vector<Found> found;
  std::vector<Across> across;
  std::vector<std::uint32_t> walking, joining;
  std::vector<std::uint8_t> altered;
  std::vector<std::uint32_t> also_chords;  ///< edges by which a visit goes to a face of a pair
  std::vector<std::uint32_t> on_arcs;      ///< faces whose walk has come to an arc on which they may lie

  std::size_t bytes() const {
    const auto of = [](const auto&... v) { return (std::size_t{0} + ... + (v.capacity() * sizeof(v[0]))); };
    return of(walks, found, across, walking, joining, altered, also_chords, on_arcs);
  }
};

// Faces of P and Q that truly face the same way.

constexpr std::uint32_t kNoFace = ~std::uint32_t{0};

struct FacePair {
  std::uint32_t p, q;
  friend auto operator<=>(const FacePair&, const FacePair&) = default;
};

/// The pairs, also by either face, and the cells in which the arcs of half-edges of such faces begin
/// (overlay_parallel.cpp).
struct FacePairs {
  std::vector<FacePair> all, parted;  ///< those now, and those of the move before
  std::array<std::vector<std::uint32_t>, 2> parallel, start;

  FacePairs(const Polytope& p, const Polytope& q);

  /// That faces of `all` are parallel; that they are not.
  void join();
  void part();
  /// The cell that the arc of each half-edge of face f of operand op, which is parallel to face g of the other one,
  /// begins in. Going round f, the arcs turn one way, and so do the cells. Calls changed(half-edge) for those that it
  /// changes.
  template <class Changed>
  void start_arcs(const Signs& signs, int op, std::uint32_t f, std::uint32_t g, const Changed& changed);

 private:
  int side_beyond(const Signs& signs, int op, HalfEdge mine, HalfEdge other) const;
};

template <class Changed>
void FacePairs::start_arcs(const Signs& signs, int op, std::uint32_t f, std::uint32_t g, const Changed& changed) {
  const Polytope &mine = signs.poly(op), &other = signs.poly(1 - op);
  HalfEdge at = other.first[g];  // leaves the cell at hand
  HalfEdge h = mine.first[f];
  std::uint32_t turned = 0;
  do {
    // The next one while it rises; at first, from a vertex that may be on the far side, until one is reached that does.
    const auto rises = [&](HalfEdge edge) { return side_beyond(signs, op, h, edge) > 0; };
    if (h == mine.first[f])
      while (!rises(at)) at = other.next[at];
    while (rises(at)) {
      at = other.next[at];
      if (++turned > 4 * (other.edge_count() + 1))
        throw std::logic_error("Overlay: a face without an outermost vertex");
    }
    std::uint32_t& begin = start[op][h];
    if (begin != other.origin[at]) {
      begin = other.origin[at];
      changed(h);
    }
    h = mine.next[h];
  } while (h != mine.first[f]);
}

// The order in which the faces of a Gauss map are visited, each from another one.

/// All faces, each but the first after a neighbour.
struct FaceVisits {
  struct Visit {
    std::uint32_t face, from;  ///< and that neighbour
    HalfEdge via;              ///< its half-edge between them
    /// A face before it to climb from: the neighbour, or, round a face of many edges, the one visited from there just
    /// before, as neighbours round such a face are closer to each other than to it.
    std::uint32_t near;
  };
  std::vector<Visit> all;

  explicit FaceVisits(const Polytope& solid);
};

/// How moves walk along all arcs of one operand: from face to face by its visits, then along the rest.
struct ArcPlan {
  std::vector<std::uint32_t> levels;  ///< where visits as far from the first face begin; one more at the end
  std::vector<std::uint32_t> chords;  ///< edges that no visit goes by

  ArcPlan(const Polytope& solid, const FaceVisits& visits);
};

// The edge of a cell across which an arc leaves it.

/// The edge at a vertex of many edges, see below: runs of faces on one side of the circle are passed at once. It is
/// kept out of the loops that walk, which it would slow down.
template <class Value, class Sign>
[[gnu::noinline]] std::uint32_t leaving_slot_of_many(const Polytope& other, std::uint32_t v, const RingBounds& bounds,
                                                     Vec3 along, double error, const Value& value, const Sign& sign) {
  const std::uint32_t begin = other.ring_start[v], size = other.ring_start[v + 1] - begin;
  const auto is_left = [&](std::uint32_t k) {
    const double side = value(begin + k);
    return std::abs(side) > error ? side > 0 : sign(begin + k) > 0;
  };
  std::uint32_t exit = size;
  bool right = is_left(size - 1);
  bounds.signs(along, error, [&](std::uint32_t first, std::uint32_t last, int side) {
    for (std::uint32_t k = first; k < last && exit == size; ++k) {
      const bool left = side == 0 ? is_left(k) : side > 0;
      if (left && !right) exit = k;
      right = left;
      if (side != 0) break;  // all alike
    }
    return exit != size;
  });
  if (exit == size) throw std::logic_error("Overlay: an arc does not leave a cell that it enters");
  return begin + exit;
}

/// An arc that enters the cell of vertex v of `other` and does not end there leaves it across the arc of the half-edge
/// from v whose left face lies on the left of the arc's circle and whose right face lies on its right: the circle
/// crosses the boundary of a convex cell once outwards. Its slot in the ring. `value(slot)` is, within `error`, on
/// which side the face on the left of a slot lies, its product with `along`; `sign(slot)` says it exactly.
template <class Value, class Sign>
std::uint32_t leaving_slot(const Polytope& other, std::uint32_t v, Vec3 along, double error, const Value& value,
                           const Sign& sign) {
  if (const RingBounds* bounds = other.bounds(other.normal_bounds, v))
    return leaving_slot_of_many(other, v, *bounds, along, error, value, sign);
  const std::uint32_t begin = other.ring_start[v], size = other.ring_start[v + 1] - begin;
  // Bit k: the face on the left of half-edge k of the ring lies on the left of the circle; the face on its right is
  // that of the one before it.
  static_assert(RingBounds::kManyEdges <= 64);
  std::uint64_t left = 0, doubt = 0;
  for (std::uint32_t k = 0; k < size; ++k) {
    const double side = value(begin + k);
    left |= std::uint64_t{side > 0} << k;
    doubt |= std::uint64_t{!(std::abs(side) > error)} << k;
  }
  for (; doubt != 0; doubt &= doubt - 1) {
    const int k = std::countr_zero(doubt);
    left &= ~(std::uint64_t{1} << k);
    left |= std::uint64_t{sign(begin + static_cast<std::uint32_t>(k)) > 0} << k;
  }
  const std::uint64_t right = (left << 1) | (left >> (size - 1));
  const std::uint64_t exits = left & ~right;
  if (exits != 0) return begin + static_cast<std::uint32_t>(std::countr_zero(exits));
  throw std::logic_error("Overlay: an arc does not leave a cell that it enters");
}

/// What one update did.
struct OverlayWork {
  std::uint64_t vertex_checks = 0;    ///< faces whose extreme vertex was checked
  std::uint64_t crossing_checks = 0;  ///< crossings whose four signs were checked one by one
  std::uint64_t vertex_errors = 0;    ///< faces whose extreme vertex changed
  std::uint64_t steps = 0;            ///< steps from vertex to vertex
  std::uint64_t arc_checks = 0;       ///< edges of the walker whose crossings were walked again, wholly or in part
  std::uint64_t arcs_changed = 0;     ///< edges of the walker whose crossings changed
  std::uint64_t crossings_added = 0, crossings_removed = 0;
  std::uint64_t exact_signs = 0;  ///< signs that doubles did not decide
};

/// Thrown by a build that finds more crossings than Overlay::limit_crossings allows.
struct TooManyCrossings {};

class Overlay {
 public:
  Overlay(const Polytope& p, const Polytope& q);

  /// Builds the overlay from nothing, by walking over both maps, O(faces + steps).
  void build(const RelativeMap& map);
  /// Limits the crossings of builds to come by walking. If one throws, the overlay is good for nothing any more.
  void limit_crossings(std::size_t most) { most_crossings_ = most; }
  /// The same by the definition: all faces with all vertices and all edges with all edges. O(m n).
  void build_brute(const RelativeMap& map);
  /// Updates the state at the map before: corrects what the motion made wrong. `use_margins` = false checks everything.
  void update(const RelativeMap& map, bool use_margins = true);

  /// The combinatorics as words: the extreme vertex of every face of P, of every face of Q, then per crossing its edge
  /// of P and half-edge of Q, kNoCrossing for numbers that are free. Crossings that stay keep their place.
  void capture(std::vector<std::uint32_t>& words) const;
  /// A captured state as that of a map: without walking, certificates and the order of crossings along arcs. Assembled
  /// it is right wherever no normal has passed over an arc since; only build may follow.
  void restore(const RelativeMap& map, std::span<const std::uint32_t> words);
  /// Memory held.
  std::size_t bytes() const;

  const Signs& signs() const { return signs_; }
  const Polytope& poly(int op) const { return signs_.poly(op); }
  /// The vertex of the other operand that is extreme in the direction of face f of operand op.
  std::uint32_t extreme(int op, std::uint32_t f) const { return extreme_[op][f]; }
  /// Faces that truly face the same way; none of operands made without merging.
  const std::vector<FacePair>& pairs() const { return pairs_.all; }
  /// The first crossing along the arc of edge e of operand op, from its left face (the face of half-edge 2e) to its
  /// right one.
  std::uint32_t first_crossing(int op, std::uint32_t e) const { return arcs_.head[op][e]; }
  const Crossing& crossing(std::uint32_t id) const { return arcs_[id]; }
  std::size_t crossing_count() const { return arcs_.count(); }
  /// Indices of crossings are below this; some may be free.
  std::uint32_t crossing_indices() const { return static_cast<std::uint32_t>(arcs_.all.size()); }
  bool is_crossing(std::uint32_t id) const { return arcs_.until[id] != kForever; }

  /// The operand whose faces and crossings have certificates.
  int walker() const { return walker_; }
  /// Whether doubles prove that all edges at the extreme vertex of face f of the walker truly fall.
  bool provably_extreme(std::uint32_t f) const { return vertex_until_[walker_][f] > clock_ || fall_in_doubles(f); }
  /// Whether doubles prove that the circle of the walker's edge truly passes between the two faces at the other one.
  bool provably_crosses(std::uint32_t id) const { return arcs_.until[id] > clock_ || passes_in_doubles(id); }

  const OverlayWork& work() const { return work_; }
  /// What the last update or build changed: faces (operand, face) with another extreme vertex, and crossings that are
  /// new. Ids are reused after removal.
  struct Changes {
    std::array<std::vector<std::uint32_t>, 2> faces;
    std::vector<std::uint32_t> crossings;
  };
  const Changes& changes() const { return changes_; }
  /// What is there counts as there before: nothing has moved yet.
  void forget_changes();

  /// Same extreme vertices, same crossings in the same order along every arc.
  friend bool operator==(const Overlay& a, const Overlay& b);

 private:
  // Shared.
  void restart();
  bool climb(int op, std::uint32_t f, std::uint32_t start, Vec3 row);
  std::uint32_t step_near_zero(int op, std::uint32_t f, std::uint32_t v);
  struct Steepest {
    double most;
    std::uint32_t at;  // in the rings
  };
  Steepest steepest_of_many(int op, std::uint32_t v, Vec3 row) const;
  void note_face(int op, std::uint32_t f);
  /// The cell in which the arc of half-edge h of operand op begins at the face of h.
  std::uint32_t end_cell(int op, HalfEdge h) const {
    const std::uint32_t f = poly(op).face[h];
    return pairs_.parallel[op][f] == kNoFace ? extreme_[op][f] : pairs_.start[op][h];
  }
  // Pairs of faces: overlay_parallel.cpp.
  std::uint32_t parallel_face(int op, std::uint32_t f) const;
  bool has_flat_edges() const { return poly(0).has_flat_edges || poly(1).has_flat_edges; }
  void find_pairs();
  void follow_pairs(std::span<const std::uint32_t> faces);
  void break_arcs_of(std::uint32_t f, std::uint32_t g);
  void keep_pairs();
  void repair_new_pairs();
  // Walks along edge e, with nothing known of it.
  void walk(std::uint32_t e);
  std::uint32_t append_crossing(std::uint32_t e, HalfEdge q, double until, std::uint32_t before);
  void finish_crossings();
  void order_along_q();
  // Updates: overlay_update.cpp.
  void correct_vertices();
  void check_crossings();
  void break_arc(std::uint32_t e, std::uint32_t by);
  void repair_broken();
  class ArcRepair;
  std::uint32_t add_crossing(std::uint32_t e, HalfEdge over);
  void remove_crossing(std::uint32_t id);
  double slack(HalfEdge over, Vec3 along) const;
  bool fall_in_doubles(std::uint32_t f) const;
  bool passes_in_doubles(std::uint32_t id) const;
  HalfEdge exit_now(HalfEdge h, std::uint32_t v, Vec3 along) const;
  HalfEdge exit_in_doubt(HalfEdge h, std::uint32_t v, Vec3 along) const;
  void settle_other_side();
  void set_vertex(int op, std::uint32_t f, std::uint32_t v);
  void spread_vertex(int op);
  // Long moves: overlay_leap.cpp.
  void leap();
  class Leap;

  Signs signs_;
  std::array<std::vector<std::uint32_t>, 2> extreme_;
  ArcCrossings arcs_;
  std::size_t most_crossings_ = std::numeric_limits<std::size_t>::max();
  FacePairs pairs_;  // not where there are flat edges, whose arcs are points
  std::array<FaceVisits, 2> visits_;
  // The operand whose faces and arcs are certified and walked in updates, the one with fewer faces; the other one's
  // follow.
  int walker_;
  ArcPlan plan_;  // of its arcs
  double cell_;   // the radius of a cell of the other operand's map, if all were alike
  /// The time until which what was checked now holds; no later however far the clock has come. kBeforeAll stays.
  double later(double margin) const { return (clock_ + margin) * exact::kDown; }

  /// A mark among the breaks of an arc, above all counts of crossings: its ends have changed.
  static constexpr std::uint32_t kEnds = std::uint32_t{1} << 31;
  // Certificates: what was checked holds until directions have moved by this angle since the start.
  double clock_ = 0;
  std::array<std::vector<double>, 2> vertex_until_;
  // Scratch, kept from update to update.
  LeapScratch leap_;
  std::vector<std::uint32_t> dropped_, uncrossed_, expired_, broken_, breaks_, spreading_;
  OverlayWork work_;
  Changes changes_;
};

}  // namespace dymsum::spatial
