#include "planar/frame/loop_cover.h"

#include <algorithm>

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

void LoopNodes::reset() {
  nodes_.assign(lists_.window().nodes.size(), {});
  visited_.assign(nodes_.size(), 0);
}

void LoopNodes::begin(bool whole) {
  doubtful_.clear();
  if (!whole) return;
  std::fill(visited_.begin(), visited_.end(), 0);
  crowded_ = 0;
}

void LoopNodes::count(const std::vector<LoopStep>& steps, bool comes) {
  for (const LoopStep& s : steps) {
    if (s.node == kNone) continue;
    std::uint32_t& visits = visited_[s.node];
    if (comes) {
      crowded_ += ++visits == 2;
      continue;
    }
    crowded_ -= visits-- == 2;
    if (visits == 0) doubtful_.push_back(s.node);
  }
}

// Whether nothing on its piece passes a touch at any scale from low to high.
bool LoopNodes::quiet(std::uint32_t touch, double low, double high) const {
  const Window& window = lists_.window();
  const PersistentTouch& v = window.touches[touch];
  if (!(v.in_low < low && v.in_high > high)) return false;
  const double margin = v.error + kShareGap * std::max(1.0, high);
  const std::uint32_t id = touch | kTouchBit;
  return lists_.stays_clear(v.piece, {v.t, v.t}, margin, {id, id}, low, high);
}

void LoopNodes::doubt(std::uint32_t node) {
  nodes_[node].inside = false;
  doubtful_.push_back(node);
}

// A node that lies in the open sum does so as long as nothing passes it on a piece it lies inside of: what could
// uncover it would cross that piece there.
void LoopNodes::find_doubtful(bool whole, double tau, double last_tau) {
  const Window& window = lists_.window();
  if (whole) {
    for (std::uint32_t n = 0; n < window.nodes.size(); ++n) doubt(n);
    return;
  }
  for (const std::uint32_t n : lists_.links().relinked()) doubt(n);
  for (const std::uint32_t piece : lists_.looked_at()) {
    for (std::uint32_t k = window.first_touch[piece]; k < window.first_touch[piece + 1]; ++k) {
      const std::uint32_t n = window.touches[k].node;
      if (nodes_[n].inside && lists_.links().active_touch(k) &&
          !quiet(k, std::min(tau, last_tau), std::max(tau, last_tau)))
        doubt(n);
    }
    for (const std::uint32_t ray : {window.head_ray[piece], window.tail_ray[piece]})
      if (ray != kNone && window.nodes[window.node_of_ray[ray]].hands_on) doubt(window.node_of_ray[ray]);
  }
}

// At every scale something touches in these nodes. The boundary passes those that it passes once; the others have to
// lie in the open sum.
bool LoopNodes::are_plain(bool whole, double tau, double last_tau, ExactFrame& frame, FrameWork& work) {
  find_doubtful(whole, tau, last_tau);
  if (crowded_ > 0) return false;
  for (const std::uint32_t n : doubtful_) {
    if (!lists_.links().active(n) || visited_[n] > 0 || nodes_[n].inside) continue;
    if (!cover_.covers_node(n, nodes_[n].witness, tau, frame, work)) return false;
    nodes_[n].inside = true;
  }
  return true;
}

}  // namespace dymsum::planar
