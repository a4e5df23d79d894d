// Where the cycles of a window of scales pass, which of them and of its nodes lie in the open sum, and which nodes they
// pass.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/doubles.h"
#include "dymsum/frames.h"
#include "planar/frame/piece_lists.h"
#include "planar/window/scaling_pairs.h"

namespace dymsum::planar {

/// A sub-edge of a cycle, and what comes after it.
struct LoopStep {
  std::uint32_t piece = kNone, edge = 0;  ///< sub-edge: PieceLists::first_sub(piece) + its place in the list
  std::uint32_t from = kNone,
                to =
                    kNone;  ///< what is at its ends, kNone at a segment's own end; valid even when the list has changed
  std::uint32_t vertex = kNone;  ///< of FrameLoops::vertices, or kNone where the next step goes straight on
  std::uint32_t node = kNone;    ///< in which it ends, where something touches at every scale
  std::int8_t turn = 0;          ///< into the next step: what it adds to the turning number
};

/// The ends of sub-edges as linear in tau, points on cycles and beside them, and the exact names of these.
class LoopPositions {
 public:
  using Step = PieceLists::Step;
  explicit LoopPositions(const PieceLists& lists) : lists_(lists) {}

  struct MovingVertex {
    SumVertex vertex;  ///< without its position
    MovingPoint point;
  };
  /// The vertex at which a sub-edge ends, between two segments.
  MovingVertex vertex_after(Step s, std::uint32_t in, std::uint32_t out) const;
  /// A point of a cycle, for collision tests just right of it: the mediant of the cuts at both ends of its longest
  /// sub-edge, as the exact layer takes it.
  SegmentPosition sample(const std::vector<LoopStep>& cycle, double tau, ExactFrame& frame) const;
  /// A point of a cycle in doubles. Edges that cross properly when Q, reflected, stands there do so at a point just
  /// right of it.
  EdgeSearch::Position beside(const std::vector<LoopStep>& cycle, double tau) const;
  /// A node in doubles, and as the exact layer takes it.
  EdgeSearch::Position at_node(std::uint32_t node, double tau) const;
  SegmentPosition exact_node(std::uint32_t node, double tau, const ExactFrame& frame) const;

 private:
  /// The position at which a sub-edge ends on its segment.
  struct Cutting {
    Linear t;
    double error;
    Cut cut;
    double denominator, relative_error;
  };
  Cutting end_cut(Step s, bool at_end) const;
  Step longest_of(const std::vector<LoopStep>& cycle, double tau) const;
  Step step_of(const LoopStep& s) const { return {s.piece, s.edge - lists_.first_sub(s.piece)}; }

  const PieceLists& lists_;
};

/// Whether cycles and nodes lie in the open sum: first by edges that cross there, remembered or found in doubles, then
/// by an exact collision test.
class LoopCover {
 public:
  explicit LoopCover(const PieceLists& lists) : positions_(lists), search_(lists.window()) {}

  /// Whether the face right of a cycle is covered. `witness`: the edges that covered it in the frame before, and do
  /// now.
  bool covers(const std::vector<LoopStep>& cycle, std::optional<CrossingEdges>& witness, double tau, ExactFrame& frame,
              FrameWork& work);
  bool covers_node(std::uint32_t node, std::optional<CrossingEdges>& witness, double tau, ExactFrame& frame,
                   FrameWork& work);

 private:
  bool witnessed(std::optional<CrossingEdges>& witness, const EdgeSearch::Position& at, FrameWork& work);
  void remember(const Collision& collision, std::optional<CrossingEdges>& witness);

  LoopPositions positions_;
  EdgeSearch search_;
};

/// The nodes in which something touches at every scale, and the loops that pass them: whether a frame needs the vertex
/// routine for any of them.
class LoopNodes {
 public:
  LoopNodes(const PieceLists& lists, LoopCover& cover) : lists_(lists), cover_(cover) {}

  /// Nothing is known of any node.
  void reset();
  /// Comes before the loops of a frame are counted; `whole`: no loops of earlier ones are.
  void begin(bool whole);
  /// A kept loop has come or gone.
  void count(const std::vector<LoopStep>& steps, bool comes);
  /// Whether the boundary passes no node twice, and those that it does not pass lie in the open sum. `last_tau`: of the
  /// frame before. Requires: all loops that came or went have been counted.
  bool are_plain(bool whole, double tau, double last_tau, ExactFrame& frame, FrameWork& work);

 private:
  void doubt(std::uint32_t node);
  void find_doubtful(bool whole, double tau, double last_tau);
  bool quiet(std::uint32_t touch, double low, double high) const;

  struct State {
    bool inside = false;  ///< proved to lie in the open sum
    std::optional<CrossingEdges> witness;
  };
  const PieceLists& lists_;
  LoopCover& cover_;
  std::vector<State> nodes_;
  std::vector<std::uint32_t> visited_;   ///< node -> how often kept loops pass it
  std::uint32_t crowded_ = 0;            ///< nodes that they pass twice or more
  std::vector<std::uint32_t> doubtful_;  ///< nodes of which something changed in this frame
};

}  // namespace dymsum::planar
