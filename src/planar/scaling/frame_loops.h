// The cycles of a window's arrangement, carried from frame to frame: those whose pieces were not looked at stay as they are, the others
// are walked again, and what is new is proved true or false.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "planar/scaling/piece_lists.h"

namespace dymsum::planar {

/// A vertex of the sum that moves with tau, in the window's coordinates.
struct MovingVertex {
  SumVertex vertex;
  Linear x, y;
  double error = 0;  ///< of the position anywhere in the window
};

struct FrameLoop {
  std::vector<PieceLists::Step> steps;
  struct Between {
    std::uint32_t piece, from, to;  ///< crossings at the ends of a sub-edge, kNone at a segment's own end
    friend bool operator==(const Between&, const Between&) = default;
  };
  std::vector<Between> edges;       ///< per step; unlike steps it stays valid when lists change
  int turning = 0;
  bool kept = false;                ///< a true boundary
  std::uint64_t ring = 0;           ///< identity of a true one, 0: not yet given
  bool fresh = true;                ///< walked anew in this frame
  std::uint32_t vertices_before = 0, vertices_shared = 0;  ///< of a fresh one: of the ring whose identity it has taken, and both
  std::optional<std::array<std::uint32_t, 2>> witness;  ///< of a false one: walk edges that crossed properly
  std::vector<MovingVertex> vertices;  ///< of a true one
};

class FrameLoops {
 public:
  explicit FrameLoops(PieceLists& lists) : lists_(lists) {}

  /// After a repair without degeneracies. `whole`: nothing is known about earlier loops. False when the boundary passes a node twice or
  /// a node may be tight: then this frame is one for the vertex routine, and nothing is known afterwards.
  bool update(double tau, FramePlace& place, bool whole, FrameWork& work);
  const std::vector<FrameLoop>& loops() const { return loops_; }
  std::vector<FrameLoop>& loops() { return loops_; }
  /// Rings that the last update has ended: identity and number of vertices.
  const std::vector<std::pair<std::uint64_t, std::uint32_t>>& ended() const { return ended_; }
  std::size_t bytes() const;

 private:
  using Step = PieceLists::Step;
  enum class Look : std::uint8_t { none, known, test };  ///< carried over; status inherited; nothing known
  void begin();
  std::vector<Look> carry_over(double tau, std::vector<FrameLoop>& gone, FrameWork& work);
  void own_edges(const std::vector<FrameLoop>& gone);
  Look inherit(FrameLoop& loop, double tau, const std::vector<FrameLoop>& gone) const;
  void trace(std::uint32_t piece, FrameWork& work);
  bool nodes_are_plain(double tau, FramePlace& place, bool whole, FrameWork& work);
  int turning_number(const std::vector<Step>& steps) const;
  std::size_t outer_loop(double tau, const std::vector<Look>& look) const;
  void verify(double tau, FramePlace& place, const std::vector<Look>& look, FrameWork& work);
  bool undisturbed(const FrameLoop::Between& edge, double tau) const;
  bool quiet(std::uint32_t touch, double tau) const;

  // frame_vertices.cpp
  bool node_inside(std::uint32_t node, double tau, FramePlace& place, FrameWork& work);
  bool is_false(FrameLoop& loop, double tau, FramePlace& place, FrameWork& work);
  struct Cutting {
    Linear t;
    double error;
    Cut cut;
    double denominator, relative_error;
  };
  Cutting end_cut(Step s, bool at_end) const;
  Place sample(const FrameLoop& loop, double tau, FramePlace& place) const;
  struct Beside {
    double x, y, error;
  };
  Beside beside(const FrameLoop& loop, double tau) const;
  std::optional<std::array<std::uint32_t, 2>> lately_crossing(double x, double y, double error, double tau) const;
  void remember(const std::optional<std::array<std::uint32_t, 2>>& edges);
  bool crosses_at(const std::array<std::uint32_t, 2>& edges, double x, double y, double error, double tau) const;
  void make_vertices(FrameLoop& loop, const std::vector<FrameLoop>& gone, std::vector<std::uint8_t>& claimed) const;
  MovingVertex vertex_after(Step s, std::uint32_t in, std::uint32_t out) const;

  PieceLists& lists_;
  std::vector<FrameLoop> loops_;
  std::vector<std::uint32_t> seen_;  ///< sub-edge -> walk
  struct Owner {
    std::uint32_t walk = 0, loop = 0, edge = 0;
  };
  std::vector<Owner> owners_;        ///< piece -> the first sub-edge on it of a loop that the current update took apart
  std::vector<std::pair<std::uint64_t, std::uint32_t>> ended_;
  std::uint32_t walk_ = 0;
  struct NodeState {
    bool inside = false;  ///< proved to lie in the open sum
    std::optional<std::array<std::uint32_t, 2>> witness;
  };
  std::vector<NodeState> nodes_;
  std::vector<std::uint32_t> visited_;  ///< node -> how often kept loops pass it
  double last_tau_ = 0;  ///< of the last update
  std::array<std::array<std::uint32_t, 2>, 16> lately_{};  ///< the last edges found to cross, of any loop or node
  std::size_t found_ = 0;
  std::vector<Step> path_;
};

}  // namespace dymsum::planar
