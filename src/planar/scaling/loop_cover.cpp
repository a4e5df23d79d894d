#include "planar/scaling/loop_cover.h"

namespace dymsum::planar {

bool LoopCover::covers(const std::vector<LoopStep>& cycle, std::optional<CrossingEdges>& witness, double tau,
                       ExactFrame& frame, FrameWork& work) {
  if (witnessed(witness, places_.beside(cycle, tau), work)) return true;
  const bool covered = frame.collision().overlaps_right_of(places_.sample(cycle, tau, frame));
  remember(frame.collision(), witness);
  return covered;
}

bool LoopCover::covers_node(std::uint32_t node, std::optional<CrossingEdges>& witness, double tau, ExactFrame& frame,
                            FrameWork& work) {
  if (witnessed(witness, places_.at_node(node, tau), work)) return true;
  const bool covered = frame.collision().overlaps(places_.exact_node(node, tau, frame));
  remember(frame.collision(), witness);
  return covered;
}

// By the edges that covered it in the frame before, or by others, which are its witness from now on. Otherwise a
// collision test has to tell.
bool LoopCover::witnessed(std::optional<CrossingEdges>& witness, const EdgeSearch::Place& at, FrameWork& work) {
  bool covered = witness && search_.cross(*witness, at);
  if (!covered) {
    if (const std::optional<CrossingEdges> edges = search_.find(at)) {
      witness = edges;
      covered = true;
    }
  }
  if (covered) {
    ++work.witnessed;
    return true;
  }
  work.witnesses_lost += witness.has_value();
  ++work.collision_tests;
  return false;
}

void LoopCover::remember(const Collision& collision, std::optional<CrossingEdges>& witness) {
  witness = collision.crossing_edges();
  if (witness) search_.remember(*witness);
}

}  // namespace dymsum::planar
