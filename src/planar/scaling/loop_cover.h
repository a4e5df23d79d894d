// Whether cycles and nodes of a window lie in the open sum: first by edges that cross there, remembered or found in
// doubles, then by an exact collision test.
#pragma once

#include <optional>
#include <vector>

#include "dymsum/frames.h"
#include "planar/scaling/loop_places.h"

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

}  // namespace dymsum::planar
