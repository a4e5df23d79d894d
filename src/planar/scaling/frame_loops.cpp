#include "planar/scaling/frame_loops.h"

#include <algorithm>
#include <cmath>

#include "planar/leftmost_loop.h"

namespace dymsum::planar {
namespace {

int half(const LiveSegment& s) { return s.dy > 0 || (s.dy == 0 && s.dx > 0) ? 0 : 1; }

}  // namespace

std::size_t FrameLoops::bytes() const {
  std::size_t n = seen_.capacity() * 4 + loops_.capacity() * sizeof(FrameLoop);
  for (const FrameLoop& l : loops_) n += l.steps.capacity() * sizeof(Step) + l.vertices.capacity() * sizeof(MovingVertex);
  return n;
}

bool FrameLoops::update(double tau, FramePlace& place, bool whole, FrameWork& work) {
  const Window& window = lists_.window();
  begin();
  std::vector<FrameLoop> gone;
  std::vector<Look> look = whole ? std::vector<Look>{} : carry_over(tau, gone, work);
  if (whole) loops_.clear();
  const std::size_t fresh = loops_.size();
  if (whole) {
    for (std::uint32_t i = 0; i < window.pieces.size(); ++i) trace(i, work);
  } else {
    // A new cycle passes a piece whose list changed: elsewhere the successor map is as it was.
    for (const std::uint32_t i : lists_.changed()) trace(i, work);
  }
  if (loops_.size() > fresh) own_edges(gone);
  for (std::size_t i = fresh; i < loops_.size(); ++i) look.push_back(inherit(loops_[i], tau, gone));
  verify(tau, place, look, work);
  std::vector<std::uint8_t> claimed(gone.size(), 0);
  for (FrameLoop& loop : loops_)
    if (loop.kept && loop.vertices.empty()) make_vertices(loop, gone, claimed);
  for (std::size_t g = 0; g < gone.size(); ++g)
    if (gone[g].kept && !claimed[g] && gone[g].ring != 0) ended_.push_back({gone[g].ring, static_cast<std::uint32_t>(gone[g].vertices.size())});
  const bool plain = window.nodes.empty() || nodes_are_plain(tau, place, whole, work);
  last_tau_ = tau;
  return plain;
}

void FrameLoops::begin() {
  const Window& window = lists_.window();
  if (seen_.size() != lists_.sub_limit() || walk_ > 0xfffffff0) {
    seen_.assign(lists_.sub_limit(), 0);
    owners_.assign(window.pieces.size(), {});
    nodes_.assign(window.nodes.size(), {});
    visited_.assign(window.nodes.size(), 0);
    walk_ = 0;
  }
  ended_.clear();
  ++walk_;
}

// Keeps the loops none of whose lists changed, with what is known of each; the others go.
std::vector<FrameLoops::Look> FrameLoops::carry_over(double tau, std::vector<FrameLoop>& gone, FrameWork& work) {
  const auto any_undisturbed = [&](const FrameLoop& loop) {
    return std::any_of(loop.edges.begin(), loop.edges.end(), [&](const FrameLoop::Between& edge) { return undisturbed(edge, tau); });
  };
  std::vector<Look> look;
  std::size_t to = 0;
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    bool changed = false, touched = false;
    for (const Step& s : loops_[i].steps) {
      changed |= lists_.has_changed(s.piece);
      touched |= lists_.touched(s.piece);
    }
    if (changed) {
      gone.push_back(std::move(loops_[i]));
      continue;
    }
    work.loops_kept += !touched;
    look.push_back(!touched ? Look::none : any_undisturbed(loops_[i]) ? Look::known : Look::test);
    loops_[i].fresh = false;
    if (to != i) loops_[to] = std::move(loops_[i]);
    ++to;
  }
  loops_.resize(to);
  return look;
}

void FrameLoops::own_edges(const std::vector<FrameLoop>& gone) {
  for (std::uint32_t g = 0; g < gone.size(); ++g)
    for (std::uint32_t k = 0; k < gone[g].edges.size(); ++k)
      if (Owner& owner = owners_[gone[g].edges[k].piece]; owner.walk != walk_) owner = {walk_, g, k};
}

// What is new inherits its status from any sub-edge that it shares with an old loop, if nothing came between; and its witness anyway.
FrameLoops::Look FrameLoops::inherit(FrameLoop& loop, double tau, const std::vector<FrameLoop>& gone) const {
  for (const FrameLoop::Between& e : loop.edges) {
    const Owner& owner = owners_[e.piece];
    if (owner.walk != walk_ || !(gone[owner.loop].edges[owner.edge] == e)) continue;
    if (!loop.witness) loop.witness = gone[owner.loop].witness;
    if (!undisturbed(e, tau)) continue;
    loop.kept = gone[owner.loop].kept;
    return Look::known;
  }
  return Look::test;
}

// Whether a sub-edge has existed, with nothing between its ends, at every scale since the last frame. A point inside it then moved
// continuously without meeting another segment, so what lies on its right is inside or outside the sum as it was (docs/design/scaling-sum.md).
bool FrameLoops::undisturbed(const FrameLoop::Between& edge, double tau) const {
  const Window& window = lists_.window();
  const double low = std::min(tau, last_tau_), high = std::max(tau, last_tau_);
  const LiveSegment& segment = window.segments[window.pieces[edge.piece].segment];
  struct End {
    Linear t;
    double error;
  };
  const auto end = [&](std::uint32_t id, Linear at_end) {
    if (id == kNone) return End{at_end, 0};
    if (id & kTouchBit) return End{window.touches[id & ~kTouchBit].t, window.touches[id & ~kTouchBit].error};
    const Candidate& c = window.candidates[id];
    return c.a == edge.piece ? End{c.ta, c.error_a} : End{c.tb, c.error_b};
  };
  for (const std::uint32_t id : {edge.from, edge.to}) {
    if (id == kNone) continue;
    const auto stays = [&](const auto& c) { return c.in_low < low && c.in_high > high; };
    if (id & kTouchBit ? !stays(window.touches[id & ~kTouchBit]) : !stays(window.candidates[id])) return false;
  }
  const End from = end(edge.from, {0, 0}), to = end(edge.to, segment.moving ? Linear{0, 1} : Linear{1, 0});
  const double margin = from.error + to.error + 0x1p-48 * std::max(1.0, high);
  for (const double x : {low, high})
    if (!(to.t.at(x) - from.t.at(x) > margin)) return false;
  // Whether something on the piece stays clear of the sub-edge while it is there.
  const auto clear = [&](const Linear& t, double error, const auto& c) {
    if (c.out_high <= low || c.out_low >= high) return true;
    const double apart = margin + error, u = std::max(low, c.out_low), v = std::min(high, c.out_high);
    return (from.t.at(u) - t.at(u) > apart && from.t.at(v) - t.at(v) > apart) || (t.at(u) - to.t.at(u) > apart && t.at(v) - to.t.at(v) > apart);
  };
  for (std::uint32_t k = window.first_of[edge.piece]; k < window.first_of[edge.piece + 1]; ++k) {
    const std::uint32_t id = window.of[k];
    const Candidate& c = window.candidates[id];
    if (id == edge.from || id == edge.to) continue;
    if (c.a == edge.piece ? !clear(c.ta, c.error_a, c) : !clear(c.tb, c.error_b, c)) return false;
  }
  for (std::uint32_t k = window.first_touch[edge.piece]; k < window.first_touch[edge.piece + 1]; ++k) {
    const PersistentTouch& c = window.touches[k];
    if ((k | kTouchBit) != edge.from && (k | kTouchBit) != edge.to && !clear(c.t, c.error, c)) return false;
  }
  return true;
}

void FrameLoops::trace(std::uint32_t piece, FrameWork& work) {
  const auto n_of = [&](std::uint32_t i) { return lists_.count(i); };
  const std::uint32_t n = n_of(piece);
  for (std::uint32_t k = 0; k <= n; ++k) {
    const Step start{piece, k};
    if (seen_[lists_.first_sub(piece) + k] >= walk_ || !lists_.alive_at_start(start)) continue;
    path_.clear();
    Step at = start;
    do {
      seen_[lists_.first_sub(at.piece) + at.sub] = walk_;
      path_.push_back(at);
      at = lists_.successor(at);
    } while (at.piece != kNone && seen_[lists_.first_sub(at.piece) + at.sub] < walk_);
    if (!(at == start)) continue;
    ++work.loops_traced;
    FrameLoop loop;
    loop.steps = path_;
    loop.turning = turning_number(path_);
    loop.edges.reserve(path_.size());
    for (const Step& s : path_)
      loop.edges.push_back({s.piece, s.sub == 0 ? kNone : lists_.entry(s.piece, s.sub - 1),
                            s.sub == n_of(s.piece) ? kNone : lists_.entry(s.piece, s.sub)});
    loops_.push_back(std::move(loop));
  }
}

int FrameLoops::turning_number(const std::vector<Step>& steps) const {
  const Window& window = lists_.window();
  int turns = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step &from = steps[i], &to = steps[(i + 1) % steps.size()];
    const Piece& p = window.pieces[from.piece];
    const int hf = half(window.segments[p.segment]), ht = half(window.segments[window.pieces[to.piece].segment]);
    if (hf == ht) continue;
    int c = p.next_turn;
    if (lists_.end_node(from) != kNone) {
      c = window.cross(p.segment, window.pieces[to.piece].segment);
    } else if (from.sub < lists_.count(from.piece)) {
      const Candidate& x = window.candidates[lists_.entry(from.piece, from.sub)];
      c = x.a == from.piece ? x.sign : -x.sign;
    }
    if (c > 0 && hf == 1) ++turns;
    if (c < 0 && hf == 0) --turns;
  }
  return turns;
}

// A connected sum has exactly one counter-clockwise true loop, the one that reaches farthest left: its number, or that of loops.
std::size_t FrameLoops::outer_loop(double tau, const std::vector<Look>& look) const {
  const std::size_t n = loops_.size();
  std::size_t count = 0, last = 0, known = n;
  for (std::size_t i = 0; i < n; ++i) {
    if (loops_[i].turning <= 0) continue;
    ++count;
    last = i;
    if (look[i] != Look::test && loops_[i].kept) known = i;
  }
  if (known < n || count == 1) return known < n ? known : last;
  const auto for_each_end = [&](std::size_t i, auto&& f) {
    for (const Step& s : loops_[i].steps) {
      const MovingVertex v = vertex_after(s, 0, 0);
      f(v.x.at(tau), v.error);
    }
  };
  return leftmost_loop(n, [&](std::size_t i) { return loops_[i].turning < 0; }, for_each_end);
}

void FrameLoops::verify(double tau, FramePlace& place, const std::vector<Look>& look, FrameWork& work) {
  const std::size_t outer = place.base().connected ? outer_loop(tau, look) : loops_.size();
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    if (look[i] != Look::test) continue;
    FrameLoop& loop = loops_[i];
    if (i == outer) {
      loop.kept = true;
    } else if (outer != loops_.size() && loop.turning > 0) {
      loop.kept = false;
    } else {
      loop.kept = !is_false(loop, tau, place, work);
    }
  }
}

// Whether nothing on its piece passed a touch at any scale since the last frame.
bool FrameLoops::quiet(std::uint32_t touch, double tau) const {
  const Window& window = lists_.window();
  const PersistentTouch& v = window.touches[touch];
  const double low = std::min(tau, last_tau_), high = std::max(tau, last_tau_);
  if (!(v.in_low < low && v.in_high > high)) return false;
  const auto passes = [&](const Linear& t, double error, const auto& c) {
    if (c.out_high <= low || c.out_low >= high) return false;
    const double apart = v.error + error + 0x1p-48 * std::max(1.0, high), u = std::max(low, c.out_low), w = std::min(high, c.out_high);
    const double gap_u = t.at(u) - v.t.at(u), gap_w = t.at(w) - v.t.at(w);
    return !(gap_u > apart && gap_w > apart) && !(gap_u < -apart && gap_w < -apart);
  };
  for (std::uint32_t k = window.first_of[v.piece]; k < window.first_of[v.piece + 1]; ++k) {
    const Candidate& c = window.candidates[window.of[k]];
    if (c.a == v.piece ? passes(c.ta, c.error_a, c) : passes(c.tb, c.error_b, c)) return false;
  }
  for (std::uint32_t k = window.first_touch[v.piece]; k < window.first_touch[v.piece + 1]; ++k)
    if (k != touch && passes(window.touches[k].t, window.touches[k].error, window.touches[k])) return false;
  return true;
}

// At every scale something touches in these nodes. The boundary passes those that it passes once; the others have to lie in the open sum.
// A node that did so does so as long as nothing passes it on a piece it lies inside of: what could uncover it would cross that piece there.
bool FrameLoops::nodes_are_plain(double tau, FramePlace& place, bool whole, FrameWork& work) {
  const Window& window = lists_.window();
  std::fill(visited_.begin(), visited_.end(), 0);
  for (const FrameLoop& loop : loops_)
    if (loop.kept)
      for (const Step& s : loop.steps)
        if (const std::uint32_t node = lists_.end_node(s); node != kNone && ++visited_[node] > 1) return false;
  for (std::uint32_t n = 0; n < window.nodes.size(); ++n) {
    if (!lists_.active(n)) {
      nodes_[n].inside = false;
      continue;
    }
    bool changed = whole || lists_.relinked(n);
    for (std::uint32_t r = window.nodes[n].first_ray; r < window.nodes[n].last_ray && nodes_[n].inside && !changed; ++r) {
      const PersistentNode::Ray& ray = window.rays[r];
      changed = ray.touch != kNone && ray.out && lists_.active_touch(ray.touch) && lists_.touched(ray.piece) && !quiet(ray.touch, tau);
    }
    if (changed) nodes_[n].inside = false;
    if (visited_[n] > 0 || nodes_[n].inside) continue;
    if (!node_inside(n, tau, place, work)) return false;
    nodes_[n].inside = true;
  }
  return true;
}

}  // namespace dymsum::planar
