// The cycles of a window's arrangement, carried from frame to frame: those whose pieces were not looked at stay as they
// are, the others are walked again, and what is new is proved true or false.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "planar/frame/frame_rings.h"
#include "planar/frame/loop_cover.h"

namespace dymsum::planar {

struct FrameLoop : LoopStatus {
  std::vector<LoopStep> steps;
  std::vector<std::uint32_t> vertices;        ///< theirs, of a kept one that has been written
  bool fresh = true;                          ///< walked anew in this frame
  bool counted = false;                       ///< among the visits of the nodes that it passes
  std::uint32_t first_run = 0, last_run = 0;  ///< of a fresh one: its runs, valid during the update
};

class FrameLoops {
 public:
  explicit FrameLoops(PieceLists& lists) : lists_(lists), positions_(lists), cover_(lists), nodes_(lists, cover_) {}

  /// Follows a repair without degeneracies. `whole`: nothing is known about earlier loops. False when the boundary
  /// passes a node twice or a node may be tight: then this frame is one for the vertex routine, and nothing is known
  /// afterwards.
  bool update(double tau, ExactFrame& frame, bool whole, FrameWork& work);
  const std::vector<FrameLoop>& loops() const { return loops_; }
  std::vector<FrameLoop>& loops() { return loops_; }
  /// The vertices that steps name by their indices; points() has their positions.
  const std::vector<SumVertex>& vertices() const { return vertices_; }
  const std::vector<MovingPoint>& points() const { return points_; }
  /// What the last update did to rings; names new ones. Requires: it knew the frame before; `kept` are the kept loops,
  /// in the order of the sum's rings. `stays`: at the same scale.
  void follow(std::span<LoopStatus* const> kept, RingIdentities& identities, bool stays, FrameChanges& changes) const;
  /// Steps that the last update took over from cycles that were gone.
  std::uint64_t copied() const { return copied_; }
  std::size_t bytes() const;

 private:
  using Step = PieceLists::Step;
  enum class Look : std::uint8_t { none, known, test };  ///< carried over; status inherited; nothing known
  void begin();
  void carry_over(double tau, FrameWork& work);
  bool stays(FrameLoop& loop);
  Look inherit(FrameLoop& loop, double tau) const;
  void count_kept(bool whole);
  void verify(double tau, ExactFrame& frame, FrameWork& work);
  bool undisturbed(const LoopStep& edge, double tau) const;
  void name_rings();
  Step step_of(const LoopStep& s) const { return {s.piece, s.edge - lists_.first_sub(s.piece)}; }

  // frame_cycles.cpp
  void take_apart(std::uint32_t index);
  void trace_new(FrameWork& work);
  void trace(Step start, FrameWork& work);
  bool follow(Step start);
  FrameLoop walked_loop();
  void add_step(Step at, Step next, FrameLoop& loop);
  std::uint32_t made(std::uint32_t& vertex, Step at, std::uint32_t next_piece);
  std::uint32_t node_vertex(Step at, std::uint32_t next_piece);

  PieceLists& lists_;
  LoopPositions positions_;
  LoopCover cover_;
  LoopNodes nodes_;
  std::vector<FrameLoop> loops_;
  std::vector<FrameLoop> gone_;  ///< taken apart by the current update
  std::vector<Look> look_;       ///< per loop
  struct Shifted {
    std::uint32_t step, sub;
  };
  std::vector<Shifted>
      shifted_;  ///< steps of a loop on pieces whose lists have changed, and where their sub-edges are now
  std::vector<std::uint32_t> seen_;  ///< sub-edge -> walk
  struct Owner {
    std::uint32_t walk = 0, loop = 0, step = 0;
  };
  std::vector<Owner> owners_;         ///< changed piece -> the first sub-edge on it of a loop that is gone
  std::vector<Owner> vertex_owners_;  ///< vertex -> the kept loop that is gone and had it
  /// Steps of a loop that is gone whose pieces did not change: walks copy them.
  struct KeptRun {
    std::uint32_t loop, begin, end;
  };
  std::vector<KeptRun> kept_runs_;
  bool enter(const KeptRun& kept_run);
  void add_kept_run(const KeptRun& kept_run, FrameLoop& loop);
  struct Head {
    std::uint32_t walk = 0, kept_run = 0;
  };
  std::vector<Head> heads_;  ///< sub-edge -> the run that starts with it
  struct Run {
    std::uint32_t at, count, corners, loop;  ///< steps of a new loop, copied from one that is gone
  };
  std::vector<Run> runs_;
  std::vector<SumVertex> vertices_;  ///< without their positions
  std::vector<MovingPoint> points_;
  struct NodeVertex {
    std::uint32_t leaving, vertex, next;  ///< ray; the next one of the same arriving ray
  };
  std::vector<std::uint32_t> crossing_vertex_, end_vertex_;  ///< candidate, piece -> vertex
  std::vector<std::uint32_t> node_vertex_;                   ///< arriving ray -> the first of its vertices
  std::vector<NodeVertex> node_vertices_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> ended_;  ///< rings: identity and count of vertices
  std::uint32_t walk_ = 0;
  std::uint64_t copied_ = 0;
  double last_tau_ = 0;  ///< of the last update
  struct Trail {
    Step at;
    std::uint32_t kept_run;  ///< that starts there, or kNone: a single sub-edge
  };
  std::vector<Trail> trail_;                  ///< of the current walk
  std::vector<std::vector<LoopStep>> spare_;  ///< storage of loops that are gone
  RingClaims claims_;
};

}  // namespace dymsum::planar
