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
#include "spatial/gauss/arc_crossings.h"
#include "spatial/gauss/face_pairs.h"
#include "spatial/gauss/face_visits.h"
#include "spatial/gauss/leap_scratch.h"
#include "spatial/gauss/signs.h"

namespace dymsum::spatial {

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
