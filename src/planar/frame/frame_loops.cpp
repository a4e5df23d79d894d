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

// Walking cycles: runs of cycles that are gone are copied where no list on them changed, the rest goes step by
// step.

// Makes the runs of a loop that is gone known by their first sub-edges; and what lies between them by piece and by
// vertex. Where the successor map is one-to-one a walk enters a run at its head only; in nodes several rays may go
// on in one.
void FrameLoops::take_apart(std::uint32_t index) {
  const FrameLoop& loop = gone_[index];
  const bool owned = loop.kept, all = owned && !lists_.window().nodes.empty();
  const auto n = static_cast<std::uint32_t>(loop.steps.size());
  const LoopStep* const steps = loop.steps.data();
  const auto own = [&](std::uint32_t k) {
    if (steps[k].vertex != kNone) vertex_owners_[steps[k].vertex] = {walk_, index, k};
  };
  for (std::uint32_t k = 0; k < n;) {
    if (lists_.has_changed(steps[k].piece)) {
      if (Owner& owner = owners_[steps[k].piece]; owner.walk != walk_) owner = {walk_, index, k};
      if (owned) own(k);
      ++k;
      continue;
    }
    const std::uint32_t begin = k;
    for (; k < n && !lists_.has_changed(steps[k].piece); ++k)
      if (all) own(k);
    heads_[steps[begin].edge] = {walk_, static_cast<std::uint32_t>(kept_runs_.size())};
    kept_runs_.push_back({index, begin, k});
  }
}

// A cycle either has a sub-edge that was not there before, or is an old one: all of its sub-edges were there, and each
// led to the next. Old ones that pass a changed list have been taken apart, so one sub-edge of each is tried too.
void FrameLoops::trace_new(FrameWork& work) {
  for (const FrameLoop& loop : gone_)
    for (const LoopStep& s : loop.steps) {
      if (!lists_.has_changed(s.piece)) continue;
      if (const Step start = lists_.between(s.piece, s.from, s.to); start.piece != kNone) trace(start, work);
      break;
    }
  for (const std::uint32_t i : lists_.changed()) {
    const PieceLists::NewSubs subs = lists_.new_subs(i);
    for (std::uint32_t k = subs.first; k <= subs.last; ++k) trace({i, k}, work);
  }
}

void FrameLoops::trace(Step start, FrameWork& work) {
  if (seen_[lists_.first_sub(start.piece) + start.sub] >= walk_ || !lists_.alive_at_start(start) || !follow(start))
    return;
  ++work.loops_traced;
  loops_.push_back(walked_loop());
}

// Walks into trail_; whether the walk comes back to where it started. Most walks do not.
bool FrameLoops::follow(Step start) {
  trail_.clear();
  Step at = start;
  std::uint32_t edge = lists_.first_sub(at.piece) + at.sub;
  do {
    const Head head = heads_[edge];
    if (head.walk == walk_) {
      const KeptRun& kept_run = kept_runs_[head.kept_run];
      if (!enter(kept_run)) return false;
      trail_.push_back({at, head.kept_run});
      at = lists_.successor(step_of(gone_[kept_run.loop].steps[kept_run.end - 1]));
    } else {
      seen_[edge] = walk_;
      trail_.push_back({at, kNone});
      at = lists_.successor(at);
    }
    if (at.piece == kNone) return false;
    edge = lists_.first_sub(at.piece) + at.sub;
  } while (seen_[edge] < walk_);
  return at == start;
}

// False where another walk has been before.
bool FrameLoops::enter(const KeptRun& kept_run) {
  const std::vector<LoopStep>& steps = gone_[kept_run.loop].steps;
  for (std::uint32_t k = kept_run.begin; k < kept_run.end; ++k) {
    if (seen_[steps[k].edge] >= walk_) return false;
    seen_[steps[k].edge] = walk_;
  }
  return true;
}

// The trail of a walk that has closed, with what is known of its steps.
FrameLoop FrameLoops::walked_loop() {
  FrameLoop loop;
  if (!spare_.empty()) {
    loop.steps = std::move(spare_.back());
    spare_.pop_back();
    loop.steps.clear();
  }
  loop.first_run = static_cast<std::uint32_t>(runs_.size());
  for (std::size_t k = 0; k < trail_.size(); ++k) {
    if (trail_[k].kept_run != kNone) add_kept_run(kept_runs_[trail_[k].kept_run], loop);
    else add_step(trail_[k].at, trail_[k + 1 < trail_.size() ? k + 1 : 0].at, loop);
  }
  loop.last_run = static_cast<std::uint32_t>(runs_.size());
  return loop;
}

void FrameLoops::add_kept_run(const KeptRun& kept_run, FrameLoop& loop) {
  const std::vector<LoopStep>& from = gone_[kept_run.loop].steps;
  std::uint32_t corners = 0;
  for (std::uint32_t k = kept_run.begin; k < kept_run.end; ++k) {
    corners += from[k].vertex != kNone;
    loop.turning += from[k].turn;
  }
  runs_.push_back(
      {static_cast<std::uint32_t>(loop.steps.size()), kept_run.end - kept_run.begin, corners, kept_run.loop});
  loop.corners += corners;
  copied_ += kept_run.end - kept_run.begin;
  loop.steps.insert(loop.steps.end(), from.begin() + kept_run.begin, from.begin() + kept_run.end);
}

// A sub-edge and what comes after it.
void FrameLoops::add_step(Step at, Step next, FrameLoop& loop) {
  LoopStep s;
  s.piece = at.piece;
  s.edge = lists_.first_sub(at.piece) + at.sub;
  s.from = at.sub == 0 ? kNone : lists_.entry(at.piece, at.sub - 1);
  s.to = at.sub == lists_.count(at.piece) ? kNone : lists_.entry(at.piece, at.sub);
  int turn = -1;  // at crossings cycles turn right
  if (s.to == kNone || s.to & kTouchBit) {
    s.node = lists_.end_node(at);
    const bool at_node = s.node != kNone;
    const Window& window = lists_.window();
    turn = at_node ? window.cross(window.pieces[at.piece].segment, window.pieces[next.piece].segment)
                   : lists_.next_turn(at.piece);
    if (turn != 0) s.vertex = at_node ? node_vertex(at, next.piece) : made(end_vertex_[at.piece], at, next.piece);
  } else {
    // The two sides of a crossing determine which arrives and which leaves: a candidate has one vertex, and so has a
    // piece's own end.
    s.vertex = made(crossing_vertex_[s.to], at, next.piece);
  }
  const int half = lists_.half(at.piece);
  if (half != lists_.half(next.piece) && (turn > 0) == (half == 1)) s.turn = static_cast<std::int8_t>(turn);
  loop.corners += s.vertex != kNone;
  loop.turning += s.turn;
  loop.steps.push_back(s);
}

// The vertex after a step, made when it is first met in the window.
std::uint32_t FrameLoops::made(std::uint32_t& vertex, Step at, std::uint32_t next_piece) {
  if (vertex != kNone) return vertex;
  const Window& window = lists_.window();
  vertex = static_cast<std::uint32_t>(vertices_.size());
  const LoopPositions::MovingVertex v =
      positions_.vertex_after(at, window.pieces[at.piece].segment, window.pieces[next_piece].segment);
  vertices_.push_back(v.vertex);
  points_.push_back(v.point);
  vertex_owners_.push_back({});
  return vertex;
}

std::uint32_t FrameLoops::node_vertex(Step at, std::uint32_t next_piece) {
  const std::uint32_t arriving = lists_.arriving_ray(at), leaving = lists_.leaving_ray(arriving);
  std::uint32_t& first = node_vertex_[arriving];
  for (std::uint32_t k = first; k != kNone; k = node_vertices_[k].next)
    if (node_vertices_[k].leaving == leaving) return node_vertices_[k].vertex;
  std::uint32_t vertex = kNone;
  node_vertices_.push_back({leaving, made(vertex, at, next_piece), first});
  first = static_cast<std::uint32_t>(node_vertices_.size() - 1);
  return vertex;
}

}  // namespace dymsum::planar
