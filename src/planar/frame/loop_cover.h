// Whether cycles and nodes of a window lie in the open sum: first by edges that cross there, remembered or found in
// doubles, then by an exact collision test.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/frames.h"
#include "planar/frame/loop_places.h"

namespace dymsum::planar {

class LoopCover {
 public:
  explicit LoopCover(const PieceLists& lists) : places_(lists), search_(lists.window()) {}

  /// Whether the face right of a cycle is covered. `witness`: the edges that covered it in the frame before, and do
  /// now.
  bool covers(const std::vector<LoopStep>& cycle, std::optional<CrossingEdges>& witness, double tau, ExactFrame& frame,
              FrameWork& work);
  bool covers_node(std::uint32_t node, std::optional<CrossingEdges>& witness, double tau, ExactFrame& frame,
                   FrameWork& work);

 private:
  bool witnessed(std::optional<CrossingEdges>& witness, const EdgeSearch::Place& at, FrameWork& work);
  void remember(const Collision& collision, std::optional<CrossingEdges>& witness);

  LoopPlaces places_;
  EdgeSearch search_;
};

// The nodes of a window in which something touches at every scale, and the loops that pass them: whether a frame needs
// the vertex routine for any of them.

class LoopNodes {
 public:
  LoopNodes(const PieceLists& lists, LoopCover& cover) : lists_(lists), cover_(cover) {}

  /// Nothing is known of any node.
  void reset();
  /// Before the loops of a frame are counted; `whole`: no loops of earlier ones are.
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
