// Walking cycles: stretches of cycles that are gone are copied where no list on them changed, the rest goes step by step.
#include "planar/scaling/frame_loops.h"

namespace dymsum::planar {

// Makes the stretches of a loop that is gone known by their first sub-edges; and what lies between them by piece and by vertex. Where the
// successor map is one-to-one a walk enters a stretch at its head only; in nodes several rays may go on in one.
void FrameLoops::take_apart(std::uint32_t number) {
  const FrameLoop& loop = gone_[number];
  const bool all = !lists_.window().nodes.empty();
  const auto n = static_cast<std::uint32_t>(loop.steps.size());
  for (std::uint32_t k = 0; k < n; ++k) {
    const LoopStep& s = loop.steps[k];
    const bool changed = lists_.has_changed(s.piece);
    if (changed)
      if (Owner& owner = owners_[s.piece]; owner.walk != walk_) owner = {walk_, number, k};
    if ((changed || all) && loop.kept && s.vertex != kNone) vertex_owners_[s.vertex] = {walk_, number, k};
    if (changed) continue;
    if (stretches_.empty() || stretches_.back().loop != number || stretches_.back().end != k) {
      heads_[s.edge] = {walk_, static_cast<std::uint32_t>(stretches_.size())};
      stretches_.push_back({number, k, k});
    }
    stretches_.back().end = k + 1;
  }
}

void FrameLoops::trace(std::uint32_t piece, FrameWork& work) {
  const std::uint32_t n = lists_.count(piece);
  for (std::uint32_t k = 0; k <= n; ++k) {
    const Step start{piece, k};
    if (seen_[lists_.first_sub(piece) + k] >= walk_ || !lists_.alive_at_start(start)) continue;
    const auto first_run = static_cast<std::uint32_t>(runs_.size());
    if (!follow(start)) {
      runs_.resize(first_run);
      continue;
    }
    ++work.loops_traced;
    FrameLoop loop;
    loop.steps = std::move(path_);
    loop.corners = path_corners_;
    loop.turning = path_turning_;
    loop.first_run = first_run;
    loop.last_run = static_cast<std::uint32_t>(runs_.size());
    loops_.push_back(std::move(loop));
    path_ = {};
    if (!spare_.empty()) {
      path_ = std::move(spare_.back());
      spare_.pop_back();
    }
  }
}

// Walks into path_ and runs_; whether the walk comes back to where it started.
bool FrameLoops::follow(Step start) {
  path_.clear();
  path_corners_ = 0;
  path_turning_ = 0;
  Step at = start;
  std::uint32_t edge = lists_.first_sub(at.piece) + at.sub;
  do {
    if (heads_[edge].walk == walk_) {
      if (!copy_stretch(heads_[edge].stretch)) return false;
      at = lists_.successor(step_of(path_.back()));
    } else {
      seen_[edge] = walk_;
      at = add_step(at, edge);
    }
    if (at.piece == kNone) return false;
    edge = lists_.first_sub(at.piece) + at.sub;
  } while (seen_[edge] < walk_);
  return at == start;
}

// False where another walk has been before.
bool FrameLoops::copy_stretch(std::uint32_t number) {
  const Stretch& stretch = stretches_[number];
  const std::vector<LoopStep>& from = gone_[stretch.loop].steps;
  std::uint32_t corners = 0;
  for (std::uint32_t k = stretch.begin; k < stretch.end; ++k) {
    const LoopStep& s = from[k];
    if (seen_[s.edge] >= walk_) return false;
    seen_[s.edge] = walk_;
    corners += s.vertex != kNone;
    path_turning_ += s.turn;
  }
  runs_.push_back({static_cast<std::uint32_t>(path_.size()), stretch.end - stretch.begin, corners, stretch.loop});
  path_corners_ += corners;
  copied_ += stretch.end - stretch.begin;
  path_.insert(path_.end(), from.begin() + stretch.begin, from.begin() + stretch.end);
  return true;
}

// Puts a sub-edge on the path and tells what comes behind it.
FrameLoops::Step FrameLoops::add_step(Step at, std::uint32_t edge) {
  const Step next = lists_.successor(at);
  if (next.piece == kNone) return next;
  LoopStep s;
  s.piece = at.piece;
  s.edge = edge;
  s.from = at.sub == 0 ? kNone : lists_.entry(at.piece, at.sub - 1);
  s.to = at.sub == lists_.count(at.piece) ? kNone : lists_.entry(at.piece, at.sub);
  int turn = -1;  // at crossings cycles turn right
  if (s.to == kNone || s.to & kTouchBit) {
    s.at_node = lists_.end_node(at) != kNone;
    const Window& window = lists_.window();
    turn = s.at_node ? window.cross(window.pieces[at.piece].segment, window.pieces[next.piece].segment) : lists_.next_turn(at.piece);
    if (turn != 0) s.vertex = s.at_node ? node_vertex(at, next.piece) : made(end_vertex_[at.piece], at, next.piece);
  } else {
    // The two sides of a crossing tell which arrives and which leaves: a candidate has one vertex, and so has a piece's own end.
    s.vertex = made(crossing_vertex_[s.to], at, next.piece);
  }
  const int half = lists_.half(at.piece);
  if (half != lists_.half(next.piece) && (turn > 0) == (half == 1)) s.turn = static_cast<std::int8_t>(turn);
  path_corners_ += s.vertex != kNone;
  path_turning_ += s.turn;
  path_.push_back(s);
  return next;
}

// The vertex behind a step, made when it is first met in the window.
std::uint32_t FrameLoops::made(std::uint32_t& vertex, Step at, std::uint32_t next_piece) {
  if (vertex != kNone) return vertex;
  const Window& window = lists_.window();
  vertex = static_cast<std::uint32_t>(vertices_.size());
  const MovingVertex v = vertex_after(at, window.pieces[at.piece].segment, window.pieces[next_piece].segment);
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
