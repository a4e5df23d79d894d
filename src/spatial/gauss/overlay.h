// The overlay of two Gauss maps: which vertex of the other solid is extreme for every face, and which arcs of edges
// cross. It is the combinatorics of the sum of convex solids, and what a motion updates. docs/design/convex-motion.md.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "exact/one_rounding.h"
#include "spatial/gauss/signs.h"

namespace dymsum::spatial {

/// Arcs of an edge of P and an edge of Q that cross: the facet edge + edge of the sum.
struct Crossing {
  std::uint32_t p = 0;  ///< edge of P
  /// Half-edge of Q that leaves the vertex extreme before the crossing, going along p's arc from its left face.
  HalfEdge q = 0;
  /// The next crossing along the arc of the edge of P, of Q; kNoCrossing at its end.
  std::array<std::uint32_t, 2> next{};
};
constexpr std::uint32_t kNoCrossing = ~std::uint32_t{0};
constexpr std::uint32_t kNoFace = ~std::uint32_t{0};

/// A crossing seen from either operand: along the arc of this edge of operand op, from its left face to its right one,
/// ...
constexpr std::uint32_t edge_of(int op, const Crossing& c) { return op == 0 ? c.p : c.q / 2; }
/// ... this half-edge of the other operand leads from the vertex extreme before the crossing to the one extreme after
/// it.
constexpr HalfEdge across(int op, const Crossing& c) { return op == 0 ? c.q : 2 * c.p + (1 - (c.q & 1)); }
/// The crossing of edge e of operand op with `over` across it.
constexpr Crossing crossing_of(int op, std::uint32_t e, HalfEdge over) {
  return op == 0 ? Crossing{e, over, {}} : Crossing{over / 2, 2 * e + (1 - (over & 1)), {}};
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

  /// From nothing: by walking over both maps, O(faces + steps).
  void build(const RelativeMap& map);
  /// Of builds to come by walking. Where one throws, the overlay is good for nothing any more.
  void limit_crossings(std::size_t most) { most_crossings_ = most; }
  /// The same by the definition: all faces with all vertices and all edges with all edges. O(m n).
  void build_brute(const RelativeMap& map);
  /// From the state at the map before: corrects what the motion made wrong. `use_margins` = false checks everything.
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
  /// Faces of P and of Q that truly face the same way; none of operands made without merging.
  struct FacePair {
    std::uint32_t p, q;
    friend auto operator<=>(const FacePair&, const FacePair&) = default;
  };
  const std::vector<FacePair>& pairs() const { return pairs_; }
  /// The first crossing along the arc of edge e of operand op, from its left face (the face of half-edge 2e) to its
  /// right one.
  std::uint32_t first_crossing(int op, std::uint32_t e) const { return head_[op][e]; }
  const Crossing& crossing(std::uint32_t id) const { return crossings_[id]; }
  std::size_t crossing_count() const { return crossings_.size() - free_.size(); }
  /// Indices of crossings are below this; some may be free.
  std::uint32_t crossing_indices() const { return static_cast<std::uint32_t>(crossings_.size()); }
  bool is_crossing(std::uint32_t id) const { return crossing_until_[id] != kForever; }

  /// The operand whose faces and crossings have certificates.
  int walker() const { return walker_; }
  /// Whether doubles prove that all edges at the extreme vertex of face f of the walker truly fall.
  bool provably_extreme(std::uint32_t f) const { return vertex_until_[walker_][f] > clock_ || fall_in_doubles(f); }
  /// Whether doubles prove that the circle of the walker's edge truly passes between the two faces at the other one.
  bool provably_crosses(std::uint32_t id) const { return crossing_until_[id] > clock_ || passes_in_doubles(id); }

  const OverlayWork& work() const { return work_; }
  /// Of the last update or build: faces (operand, face) with another extreme vertex, and crossings that are new. Ids
  /// are reused after removal.
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
  // Of a long move: an arc of the walker that is walked, ...
  struct Walk {
    Vec3 row;                    // of the face to reach, where there is one
    std::array<float, 3> along;  // its edge's direction, mapped
    HalfEdge h;                  // the way that it is walked
    std::uint32_t v;             // the cell at hand
    std::uint32_t goal;          // the face to reach, or the last cell
    std::uint32_t after;         // the crossing found after which the next one is put, in the order of the edge's arc
  };
  // ... a crossing found, in lists along the arcs of both operands, ...
  struct Found {
    std::uint32_t e;
    HalfEdge over;
    std::uint32_t next, next_across, id;
  };
  // ... and an arc of the other operand: the first of its crossings in any order, the cells of its ends.
  struct Across {
    std::uint32_t first, count, begin, end;
  };
  // Shared.
  void restart();
  void make_levels();
  bool climb(int op, std::uint32_t f, std::uint32_t start, Vec3 row);
  std::uint32_t step_near_zero(int op, std::uint32_t f, std::uint32_t v);
  struct Steepest {
    double most;
    std::uint32_t at;  // in the rings
  };
  Steepest steepest_of_many(int op, std::uint32_t v, Vec3 row) const;
  void note_face(int op, std::uint32_t f);
  void touch(int op, std::uint32_t e);
  std::uint32_t order_along(int op, std::uint32_t e, std::uint32_t v);
  /// The cell in which the arc of half-edge h of operand op begins at the face of h.
  std::uint32_t end_cell(int op, HalfEdge h) const {
    const std::uint32_t f = poly(op).face[h];
    return parallel_[op][f] == kNoFace ? extreme_[op][f] : start_[op][h];
  }
  // Pairs of faces: overlay_parallel.cpp.
  std::uint32_t parallel_face(int op, std::uint32_t f) const;
  int side_beyond(int op, HalfEdge mine, HalfEdge other) const;
  template <class Changed>
  void start_arcs(int op, std::uint32_t f, std::uint32_t g, const Changed& changed);
  void find_pairs();
  void join_pairs();
  void follow_pairs(std::span<const std::uint32_t> faces);
  void break_arcs_of(std::uint32_t f, std::uint32_t g);
  void keep_pairs();
  void repair_new_pairs();
  // From nothing.
  void clear_crossings();
  void walk(std::uint32_t e);
  std::uint32_t append_crossing(std::uint32_t e, HalfEdge q, double until, std::uint32_t before);
  void finish_crossings();
  void order_along_q();
  // Updates: overlay_update.cpp.
  void correct_vertices();
  void check_crossings();
  void break_arc(std::uint32_t e, std::uint32_t by);
  void repair_broken();
  void repair_arc(std::uint32_t e);
  std::uint32_t add_crossing(std::uint32_t e, HalfEdge over);
  void remove_crossing(std::uint32_t id);
  double slack(HalfEdge over, Vec3 along) const;
  bool fall_in_doubles(std::uint32_t f) const;
  bool passes_in_doubles(std::uint32_t id) const;
  HalfEdge exit_now(HalfEdge h, std::uint32_t v, Vec3 along) const;
  HalfEdge exit_in_doubt(HalfEdge h, std::uint32_t v, Vec3 along) const;
  std::pair<std::uint32_t, std::uint32_t> cells_of_ends(int op, std::uint32_t e);
  void settle_other_side();
  void set_vertex(int op, std::uint32_t f, std::uint32_t v);
  void spread_vertex(int op);
  void free_crossing(std::uint32_t id);
  // Long moves: overlay_leap.cpp.
  void leap();
  void walk_to_faces(std::size_t begin, std::size_t end);
  void walk_chords();
  void step_to_faces(float error);
  void step_chords(float error);
  HalfEdge exit_of(const Walk& walk, float error) const;
  void list_found_across();
  void keep_numbers();
  void write_found();
  void follow_found();

  Signs signs_;
  std::array<std::vector<std::uint32_t>, 2> extreme_;
  std::array<std::vector<std::uint32_t>, 2> head_;
  std::vector<Crossing> crossings_;
  std::size_t most_crossings_ = std::numeric_limits<std::size_t>::max();
  std::vector<std::uint32_t> free_;
  // Pairs of faces that face the same way, also by either face, and the cells in which the arcs of half-edges of such
  // faces begin. Not where there are flat edges, whose arcs are points.
  std::vector<FacePair> pairs_, parted_;
  std::array<std::vector<std::uint32_t>, 2> parallel_, start_;
  bool has_flat_edges_ = false;
  // Faces in an order in which each but the first comes after a neighbour, that neighbour, its half-edge between them,
  // and a face before it to climb from: the neighbour, or, round a face of many edges, the one visited from there just
  // before, as neighbours round such a face are closer to each other than to it.
  struct Visit {
    std::uint32_t face, from;
    HalfEdge via;
    std::uint32_t near;
  };
  std::array<std::vector<Visit>, 2> visits_;
  // The operand whose faces and arcs are certified and walked in updates, the one with fewer faces; the other one's
  // follow.
  int walker_ = 0;
  std::vector<std::uint32_t> chords_;       // its edges that no visit goes by
  std::vector<std::uint32_t> also_chords_;  // those by which a visit goes to a face of a pair
  std::vector<std::uint32_t> levels_;       // where its visits as far from the first face begin; one more at the end
  double cell_ = 0;                         // the radius of a cell of the other operand's map, if all were alike
  /// The time until which what was checked now holds; no later however far the clock has come. kBeforeAll stays.
  double later(double margin) const { return (clock_ + margin) * exact::kDown; }

  static constexpr double kForever = std::numeric_limits<double>::infinity(), kBeforeAll = -kForever;
  /// Among the breaks of an arc, above all counts of crossings: its ends have changed.
  static constexpr std::uint32_t kEnds = std::uint32_t{1} << 31;
  // Certificates: what was checked holds until directions have moved by this angle since the start.
  double clock_ = 0;
  std::array<std::vector<double>, 2> vertex_until_;
  std::vector<double> crossing_until_;
  // Scratch, kept from update to update.
  std::vector<Walk> walks_;
  std::vector<Found> found_;
  std::vector<Across> across_;
  std::vector<std::uint32_t> walking_, joining_;
  std::vector<std::uint8_t> altered_;
  std::vector<std::uint32_t> dropped_, touched_, uncrossed_, expired_, broken_, breaks_, spreading_, on_arcs_;
  std::array<std::vector<std::uint8_t>, 2> is_touched_;
  OverlayWork work_;
  Changes changes_;
};

}  // namespace dymsum::spatial
