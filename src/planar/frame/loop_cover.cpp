#include "planar/frame/loop_cover.h"

#include <algorithm>
#include <cmath>

#include "planar/operand/lattice.h"

namespace dymsum::planar {

LoopPositions::Cutting LoopPositions::end_cut(Step s, bool at_end) const {
  const Window& window = lists_.window();
  const LiveSegment& on = window.segments[window.pieces[s.piece].segment];
  Cutting c;
  c.relative_error = kLengthWeight;
  const bool end = at_end && s.sub == lists_.count(s.piece), start = !at_end && s.sub == 0;
  if (end || start) {
    const Piece& piece = window.pieces[s.piece];
    c.cut.pair = window.exact(end ? window.end_pair(piece) : on.start);
    c.t = end ? window.end_position(piece) : Linear{0, 0};
    c.error = end ? piece.tail_error : 0;
    c.denominator = on.dx != 0 ? std::abs(on.dx) : std::abs(on.dy);
    return c;
  }
  const std::uint32_t entry = lists_.entry(s.piece, at_end ? s.sub : s.sub - 1);
  const PieceLists::Line line = lists_.line(s.piece, entry);
  c.t = line.t;
  c.error = line.error;
  if (entry & kTouchBit) {
    c.cut.pair = window.exact(window.nodes[window.touches[entry & ~kTouchBit].node].at);
    c.denominator = on.dx != 0 ? std::abs(on.dx) : std::abs(on.dy);
    return c;
  }
  const Candidate& x = window.candidates[entry];
  const std::uint32_t other = window.pieces[x.a == s.piece ? x.b : x.a].segment;
  const LiveSegment& by = window.segments[other];
  c.cut.kind = Cut::Kind::crossing;
  c.cut.by = window.exact(other);
  const double u = on.dx * by.dy, v = on.dy * by.dx, d = std::abs(u - v);
  c.denominator = d * window.base().given->integers_per_unit;
  c.relative_error = d > 0 ? std::min(1.0, kCrossWeight * (std::abs(u) + std::abs(v)) / d) : 1.0;
  return c;
}

LoopPositions::Step LoopPositions::longest_of(const std::vector<LoopStep>& cycle, double tau) const {
  const Window& window = lists_.window();
  // Doubles know nothing of lengths between nearly parallel lines: they may be less than nothing, or no numbers.
  Step longest = step_of(cycle.front());
  double best = -1;
  for (const LoopStep& step : cycle) {
    const Step s = step_of(step);
    const LiveSegment& on = window.segments[window.pieces[s.piece].segment];
    const double l = (end_cut(s, true).t.at(tau) - end_cut(s, false).t.at(tau)) * (std::abs(on.dx) + std::abs(on.dy));
    if (l > best) {
      best = l;
      longest = s;
    }
  }
  return longest;
}

SegmentPosition LoopPositions::sample(const std::vector<LoopStep>& cycle, double tau, ExactFrame& frame) const {
  const Window& window = lists_.window();
  const std::uint32_t moving = window.frame().moving;
  const Step longest = longest_of(cycle, tau);
  const std::uint32_t segment = window.pieces[longest.piece].segment;
  const LiveSegment& on = window.segments[segment];
  const Cutting from = end_cut(longest, false), to = end_cut(longest, true);
  // Denominators of crossings with an edge of the scaled operand grow with the scale; all are integers over the common
  // denominator of the frame's lattice.
  const auto weight_of = [&](const Cutting& c) {
    if (c.cut.kind == Cut::Kind::pair) return c.denominator;
    const double den = exact::round_to_double(exact::BigRational(frame.scale().den));
    return c.denominator * den * (c.cut.by.edge.op == frame.base().moved ? frame.value().approx : 1);
  };
  const double d0 = weight_of(from), d1 = weight_of(to), t0 = from.t.at(tau), t1 = to.t.at(tau);
  double weight = d0 + d1 > 0 ? d1 / (d0 + d1) : 0.5, relative = from.relative_error + to.relative_error + kMediant;
  if (!(weight >= 0 && weight <= 1)) {
    weight = 0.5;
    relative = 1;
  }
  const double t = t0 + weight * (t1 - t0), t_error = from.error + to.error +
                                                      std::abs(t1 - t0) * kMediantFractions * relative +
                                                      kFraction * std::max(1.0, tau);
  SegmentPosition p;
  p.on = window.exact(segment);
  p.first = from.cut;
  p.second = to.cut;
  p.between = true;
  const double grow = frame.blow_up(moving);
  p.x = grow * (on.x.at(tau) + t * on.dx);
  p.y = grow * (on.y.at(tau) + t * on.dy);
  p.error =
      grow * (t_error * std::max(std::abs(on.dx), std::abs(on.dy)) + kWindowPoint * window.span()) * exact::kOutwards;
  // Nearly parallel lines, of which the doubles know nothing.
  if (!std::isfinite(p.error)) round_position(frame.lattice(), p);
  return p;
}

EdgeSearch::Position LoopPositions::beside(const std::vector<LoopStep>& cycle, double tau) const {
  const Window& window = lists_.window();
  const Step s = step_of(cycle[0]);
  const LiveSegment& on = window.segments[window.pieces[s.piece].segment];
  const Cutting from = end_cut(s, false), to = end_cut(s, true);
  const double t = 0.5 * (from.t.at(tau) + to.t.at(tau));
  const double error =
      (from.error + to.error + kFraction * std::max(1.0, tau)) * std::max(std::abs(on.dx), std::abs(on.dy)) +
      kWindowPoint * window.span();
  return {on.x.at(tau) + t * on.dx, on.y.at(tau) + t * on.dy, error, tau};
}

EdgeSearch::Position LoopPositions::at_node(std::uint32_t node, double tau) const {
  const Window& window = lists_.window();
  const MovingPoint at = window.position(window.nodes[node].at);
  return {at.x.at(tau), at.y.at(tau), kWindowPoint * window.span(), tau};
}

SegmentPosition LoopPositions::exact_node(std::uint32_t node, double tau, const ExactFrame& frame) const {
  const Window& window = lists_.window();
  const PersistentNode& n = window.nodes[node];
  const EdgeSearch::Position at = at_node(node, tau);
  const double grow = frame.blow_up(window.frame().moving);
  SegmentPosition p;
  p.on = window.exact(window.pieces[window.rays[n.first_ray].piece].segment);
  p.first.pair = window.exact(n.at);
  p.x = grow * at.x;
  p.y = grow * at.y;
  p.error = grow * 2 * kWindowPoint * window.span();
  return p;
}

LoopPositions::MovingVertex LoopPositions::vertex_after(Step s, std::uint32_t in, std::uint32_t out) const {
  const Window& window = lists_.window();
  MovingVertex v;
  const bool end = s.sub == lists_.count(s.piece);
  const std::uint32_t entry = end ? kNone : lists_.entry(s.piece, s.sub);
  if (end || entry & kTouchBit) {
    const WalkPair at =
        end ? window.end_pair(window.pieces[s.piece]) : window.nodes[window.touches[entry & ~kTouchBit].node].at;
    v.vertex.corner_p = window.base().operands[0].vertex_index[at.p];
    v.vertex.corner_q = window.base().operands[1].vertex_index[at.q];
    v.point = window.position(at);
  } else {
    const Candidate& c = window.candidates[entry];
    const LiveSegment &a = window.segments[window.pieces[c.a].segment],
                      &b = window.segments[window.pieces[c.b].segment];
    const double ea = c.error_a * std::max(std::abs(a.dx), std::abs(a.dy)),
                 eb = c.error_b * std::max(std::abs(b.dx), std::abs(b.dy));
    const LiveSegment& best = ea <= eb ? a : b;
    const Linear& t = ea <= eb ? c.ta : c.tb;
    v.point.x = {best.x.a + best.dx * t.a, best.x.b + best.dx * t.b};
    v.point.y = {best.y.a + best.dy * t.a, best.y.b + best.dy * t.b};
    v.point.error = std::min(ea, eb);
    // Where the line is followed far outside the piece, a and b cancel at tau.
    v.point.error += kFollowed * (std::abs(v.point.x.a) + std::abs(v.point.y.a) +
                                  (std::abs(v.point.x.b) + std::abs(v.point.y.b)) * window.frame().tau1);
  }
  v.point.error += kWindowPoint * window.span();
  v.vertex.in = window.segments[in].contact;
  v.vertex.out = window.segments[out].contact;
  return v;
}

bool LoopCover::covers(const std::vector<LoopStep>& cycle, std::optional<CrossingEdges>& witness, double tau,
                       ExactFrame& frame, FrameWork& work) {
  if (witnessed(witness, positions_.beside(cycle, tau), work)) return true;
  const bool covered = frame.collision().overlaps_right_of(positions_.sample(cycle, tau, frame));
  remember(frame.collision(), witness);
  return covered;
}

bool LoopCover::covers_node(std::uint32_t node, std::optional<CrossingEdges>& witness, double tau, ExactFrame& frame,
                            FrameWork& work) {
  if (witnessed(witness, positions_.at_node(node, tau), work)) return true;
  const bool covered = frame.collision().overlaps(positions_.exact_node(node, tau, frame));
  remember(frame.collision(), witness);
  return covered;
}

// The edges that covered the loop in the frame before are tried, then others, which are its witness from now on.
// Otherwise a collision test has to decide.
bool LoopCover::witnessed(std::optional<CrossingEdges>& witness, const EdgeSearch::Position& at, FrameWork& work) {
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
  const double margin = v.error + kFractionGap * std::max(1.0, high);
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
