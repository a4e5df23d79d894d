#include "planar/frame/frame_loops.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {
std::size_t FrameLoops::bytes() const {
  std::size_t n =
      bytes_of(seen_, crossing_vertex_, end_vertex_, heads_, owners_, vertex_owners_, vertices_, points_, loops_);
  for (const FrameLoop& l : loops_) n += bytes_of(l.steps, l.vertices);
  for (const std::vector<LoopStep>& s : spare_) n += bytes_of(s);
  return n;
}

bool FrameLoops::update(double tau, ExactFrame& frame, bool whole, FrameWork& work) {
  const Window& window = lists_.window();
  begin();
  if (whole) loops_.clear();
  else carry_over(tau, work);
  const std::size_t fresh = loops_.size();
  if (whole) {
    for (std::uint32_t i = 0; i < window.pieces.size(); ++i)
      for (std::uint32_t k = 0; k <= lists_.count(i); ++k) trace({i, k}, work);
  } else {
    trace_new(work);
  }
  for (std::size_t i = fresh; i < loops_.size(); ++i) look_.push_back(inherit(loops_[i], tau));
  verify(tau, frame, work);
  name_rings();
  count_kept(whole);
  for (FrameLoop& loop : gone_) spare_.push_back(std::move(loop.steps));
  const bool plain = nodes_.are_plain(whole, tau, last_tau_, frame, work);
  last_tau_ = tau;
  return plain;
}

void FrameLoops::begin() {
  const Window& window = lists_.window();
  if (seen_.size() != lists_.sub_limit() || walk_ > 0xfffffff0) {
    seen_.assign(lists_.sub_limit(), 0);
    heads_.assign(lists_.sub_limit(), {});
    owners_.assign(window.pieces.size(), {});
    vertex_owners_.assign(vertices_.size(), {});
    crossing_vertex_.resize(window.candidates.size(), kNone);
    end_vertex_.resize(window.pieces.size(), kNone);
    node_vertex_.resize(window.rays.size(), kNone);
    nodes_.reset();
    walk_ = 0;
  }
  copied_ = 0;
  ended_.clear();
  gone_.clear();
  look_.clear();
  runs_.clear();
  kept_runs_.clear();
  ++walk_;
}

// Whether a cycle some of whose lists have changed is there all the same: changes elsewhere on a piece only shift its
// sub-edges' numbers. New sub-edges beside them are tried; these are not.
bool FrameLoops::stays(FrameLoop& loop) {
  const auto n = static_cast<std::uint32_t>(loop.steps.size());
  shifted_.clear();
  for (std::uint32_t k = 0; k < n; ++k) {
    const LoopStep& s = loop.steps[k];
    if (!lists_.has_changed(s.piece)) continue;
    const Step now = lists_.between(s.piece, s.from, s.to);
    if (now.piece == kNone || ((s.to & kTouchBit) != 0 && lists_.end_node(now) != s.node)) return false;
    shifted_.push_back({k, now.sub});
  }
  for (std::size_t i = 0; i < shifted_.size(); ++i) {
    const auto [k, sub] = shifted_[i];
    const LoopStep& next = loop.steps[k + 1 == n ? 0 : k + 1];
    const Step to = lists_.has_changed(next.piece)
                        ? Step{next.piece, shifted_[i + 1 == shifted_.size() ? 0 : i + 1].sub}
                        : step_of(next);
    if (!(lists_.successor({loop.steps[k].piece, sub}) == to)) return false;
  }
  for (const auto [k, sub] : shifted_) {
    LoopStep& s = loop.steps[k];
    s.edge = lists_.first_sub(s.piece) + sub;
    seen_[s.edge] = walk_;
  }
  return true;
}

// Keeps the loops that are still there, with what is known of each; the others go.
void FrameLoops::carry_over(double tau, FrameWork& work) {
  std::size_t to = 0;
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    FrameLoop& loop = loops_[i];
    bool changed = false, touched = false;
    for (const LoopStep& s : loop.steps) {
      touched |= lists_.touched(s.piece);
      changed |= lists_.has_changed(s.piece);
    }
    if (changed && !stays(loop)) {
      gone_.push_back(std::move(loop));
      take_apart(static_cast<std::uint32_t>(gone_.size() - 1));
      continue;
    }
    work.loops_kept += !touched;
    const auto quiet_edge = [&](const LoopStep& s) { return undisturbed(s, tau); };
    look_.push_back(!touched                                                        ? Look::none
                    : std::any_of(loop.steps.begin(), loop.steps.end(), quiet_edge) ? Look::known
                                                                                    : Look::test);
    loop.fresh = false;
    loop.vertices_before = loop.vertices_shared = loop.corners;
    if (to != i) loops_[to] = std::move(loop);
    ++to;
  }
  loops_.resize(to);
}

// What is new inherits its status from any sub-edge that it shares with an old loop, if nothing came between; and its
// witness anyway.
FrameLoops::Look FrameLoops::inherit(FrameLoop& loop, double tau) const {
  const auto fractions = [&](const LoopStep& s, const FrameLoop& old) {
    if (!loop.witness) loop.witness = old.witness;
    if (!undisturbed(s, tau)) return false;
    loop.kept = old.kept;
    return true;
  };
  for (std::uint32_t r = loop.first_run; r < loop.last_run; ++r)
    for (std::uint32_t k = 0; k < runs_[r].count; ++k)
      if (fractions(loop.steps[runs_[r].at + k], gone_[runs_[r].loop])) return Look::known;
  for (const LoopStep& s : loop.steps) {
    const Owner& owner = owners_[s.piece];
    if (owner.walk != walk_) continue;
    const LoopStep& old = gone_[owner.loop].steps[owner.step];
    if (old.from == s.from && old.to == s.to && fractions(s, gone_[owner.loop])) return Look::known;
  }
  return Look::test;
}

// A fresh ring takes the identity of the first kept loop that is gone and had one of its vertices.
void FrameLoops::name_rings() {
  claims_.begin_frame(gone_.size());
  for (FrameLoop& loop : loops_) {
    if (!loop.kept || !loop.fresh) continue;
    claims_.begin(loop);
    const auto fractions = [&](std::uint32_t old, std::uint32_t vertices) {
      if (gone_[old].kept) claims_.fractions(old, gone_[old], vertices);
    };
    std::uint32_t r = loop.first_run;
    for (std::uint32_t k = 0; k < loop.steps.size();) {
      if (r < loop.last_run && runs_[r].at == k) {
        if (runs_[r].corners > 0) fractions(runs_[r].loop, runs_[r].corners);
        k += runs_[r++].count;
        continue;
      }
      const std::uint32_t v = loop.steps[k++].vertex;
      if (v != kNone && vertex_owners_[v].walk == walk_) fractions(vertex_owners_[v].loop, 1);
    }
  }
  for (std::size_t g = 0; g < gone_.size(); ++g)
    if (gone_[g].kept && !claims_.claimed(g) && gone_[g].ring != 0) ended_.push_back({gone_[g].ring, gone_[g].corners});
}

// Whether a sub-edge has existed, with nothing between its ends, at every scale since the last frame. A point inside it
// then moved continuously without meeting another segment, so what lies on its right is inside or outside the sum as it
// was (docs/design/scaling-sum.md).
bool FrameLoops::undisturbed(const LoopStep& edge, double tau) const {
  // What was not looked at is proved over an interval with both frames inside.
  if (!lists_.touched(edge.piece)) return true;
  const Window& window = lists_.window();
  const double low = std::min(tau, last_tau_), high = std::max(tau, last_tau_);
  const Piece& piece = window.pieces[edge.piece];
  const auto end = [&](std::uint32_t id, Linear at_end) {
    return id == kNone ? PieceLists::Line{at_end, 0} : lists_.line(edge.piece, id);
  };
  for (const std::uint32_t id : {edge.from, edge.to}) {
    if (id == kNone) continue;
    const auto stays = [&](const auto& c) { return c.in_low < low && c.in_high > high; };
    if (id & kTouchBit ? !stays(window.touches[id & ~kTouchBit]) : !stays(window.candidates[id])) return false;
  }
  const PieceLists::Line from = end(edge.from, {0, 0}), to = end(edge.to, window.end_position(piece));
  const double margin = from.error + to.error + piece.tail_error + kFractionGap * std::max(1.0, high);
  for (const double x : {low, high})
    if (!(to.t.at(x) - from.t.at(x) > margin)) return false;
  // Whether everything else on the piece stays clear of the sub-edge while it is there.
  return lists_.stays_clear(edge.piece, {from.t, to.t}, margin, {edge.from, edge.to}, low, high);
}

void FrameLoops::verify(double tau, ExactFrame& frame, FrameWork& work) {
  const auto for_each_end = [&](std::size_t i, auto&& f) {
    for (const LoopStep& s : loops_[i].steps) {
      const MovingPoint v = positions_.vertex_after(step_of(s), 0, 0).point;
      f(v.x.at(tau), v.error);
    }
  };
  decide_loops(
      loops_, frame.base().connected, [&](std::size_t i) { return look_[i] != Look::test; }, for_each_end,
      [&](FrameLoop& loop) { return cover_.covers(loop.steps, loop.witness, tau, frame, work); });
  for (FrameLoop& loop : loops_)
    if (!loop.kept && loop.ring != 0) {
      ended_.push_back({loop.ring, loop.corners});
      loop.ring = 0;
    }
}

// Kept loops that came or went count at the nodes they pass.
void FrameLoops::count_kept(bool whole) {
  nodes_.begin(whole);
  for (const FrameLoop& loop : gone_)
    if (loop.counted) nodes_.count(loop.steps, false);
  for (FrameLoop& loop : loops_) {
    if (loop.counted != loop.kept) nodes_.count(loop.steps, loop.kept);
    loop.counted = loop.kept;
  }
}

void FrameLoops::follow(std::span<LoopStatus* const> kept, RingIdentities& identities, bool stays,
                        FrameChanges& changes) const {
  identities.follow(kept, stays, changes);
  for (const auto& [ring, vertices] : ended_)
    changes.rings.push_back({RingChange::Kind::disappeared, ring, 0, vertices});
}

}  // namespace dymsum::planar
