// Walking cycles: runs of cycles that are gone are copied where no list on them changed, the rest goes step by
// step.
#include "planar/frame/frame_loops.h"

namespace dymsum::planar {

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
