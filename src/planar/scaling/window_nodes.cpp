// What touches at every scale: ends of segments that stay on the lines of others, and the nodes they make.
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "planar/scaling/edge_search.h"
#include "planar/scaling/window.h"

namespace dymsum::planar {

// A side is linear in s: zero at s = 1 and s = 2 is zero always.
bool Window::always_on(std::uint32_t segment, Pair v) {
  const Segment s = exact(segment);
  if (base_.lattice->side(s, v) != 0) return false;
  if (doubled_ == nullptr) {
    const ScaleValue two = scale_value(exact::BigRational(2));
    doubled_ = base_.lattice_at(base_.lattice_scale(two, two));
  }
  return doubled_->side(s, v) == 0;
}

// Whether an end of one piece of a pair stays on the line of the other; then they touch there or not at all, and are no
// candidate.
bool Window::touch_always(const Candidate& c, std::array<bool, 2> at_a, std::array<bool, 2> at_b) {
  const std::uint32_t si = pieces[c.a].segment, sj = pieces[c.b].segment;
  const LiveSegment &a = segments[si], &b = segments[sj];
  const WalkPair end_a = end_pair(pieces[c.a]), end_b = end_pair(pieces[c.b]);
  const bool start_a = at_a[0] && always_on(sj, exact(a.start)), start_b = at_b[0] && always_on(si, exact(b.start));
  const bool a_on_b = start_a || (at_a[1] && always_on(sj, exact(end_a))),
             b_on_a = start_b || (at_b[1] && always_on(si, exact(end_b)));
  if (!a_on_b && !b_on_a) return false;
  touching.push_back({si, sj});
  if (a_on_b && b_on_a) folds.push_back({si, sj});
  else if (a_on_b) add_touch(c.b, start_a ? a.start : end_a, c.tb, c.error_b);
  else add_touch(c.a, start_b ? b.start : end_b, c.ta, c.error_a);
  return true;
}

void Window::add_touch(std::uint32_t piece, WalkPair v, const Linear& t, double error) {
  Candidate c;
  c.out_low = c.in_low = -INFINITY;
  c.out_high = c.in_high = INFINITY;
  std::array<bool, 2> unsure{};
  if (!bounds(piece, t, error, c, unsure) || c.out_high <= frame_.tau0 || c.out_low >= frame_.tau1) return;
  PersistentTouch touch;
  touch.piece = piece;
  touch.t = t;
  touch.error = error;
  touch.out_low = c.out_low;
  touch.in_low = c.in_low;
  touch.in_high = c.in_high;
  touch.out_high = c.out_high;
  touches.push_back(touch);
  touch_pair_.push_back(v);
}

// Two parallel segments on one line at every scale: each end inside the other one touches it.
void Window::touch_parallel(std::uint32_t i, std::uint32_t j) {
  const std::size_t before = touches.size();
  for (const auto& [on_piece, other] : {std::pair{i, j}, std::pair{j, i}}) {
    const LiveSegment &on = segments[pieces[on_piece].segment], &s = segments[pieces[other].segment];
    const double length = on.dx * on.dx + on.dy * on.dy;
    const double error = 2 * kWindowSide * span_ * (std::abs(on.dx) + std::abs(on.dy)) / length +
                         kProjection * std::max(1.0, frame_.tau1);
    for (const bool end : {false, true}) {
      const double f = end ? (s.moving ? 0 : 1) : 0,
                   m = end && s.moving ? 1 : 0;  // the end lies one vector further, times tau if it moves
      const double ax = s.x.a + f * s.dx - on.x.a, ay = s.y.a + f * s.dy - on.y.a, bx = s.x.b + m * s.dx - on.x.b,
                   by = s.y.b + m * s.dy - on.y.b;
      add_touch(on_piece, end ? s.end : s.start,
                {(ax * on.dx + ay * on.dy) / length, (bx * on.dx + by * on.dy) / length}, error);
    }
  }
  if (touches.size() == before) return;
  const std::uint32_t si = pieces[i].segment, sj = pieces[j].segment;
  touching.push_back({si, sj});
  // Against each other they cover both sides of a line: a crack, unless inside.
  if (base_.lattice->dot(exact(si).edge, exact(sj).edge) < 0) folds.push_back({si, sj});
}

// Touches grouped by their pair of vertices; segments through one node meet there only, so they are no candidates.
void Window::make_nodes(bool covers) {
  head_ray.assign(pieces.size(), kNone);
  tail_ray.assign(pieces.size(), kNone);
  NodeRays at = take_touches();
  for (const Piece& p : pieces)
    if (p.handed_on && !p.covered) at[{p.tail_at.p, p.tail_at.q}];
  if (at.empty()) return;
  add_end_rays(at);
  for (auto& [v, list] : at) {
    sort_rays(list);
    add_node({v.first, v.second}, list);
  }
  drop_pairs_through_nodes();
  if (covers) drop_covered_nodes();
}

// Pieces pass and end there as if nothing touched: what begins or ends in the open sum is false.
void Window::drop_covered_nodes() {
  EdgeSearch search(*this);
  const Lattice& l = *base_.lattice;
  for (PersistentNode& node : nodes) {
    const Pair v = exact(node.at);
    const std::uint32_t m = frame_.moving, move = m == 0 ? v.p : v.q, rest = m == 0 ? v.q : v.p;
    const auto at = [&](double tau) {
      return EdgeSearch::Place{l.points[1 - m]->x[rest] + tau * l.points[m]->x[move],
                               l.points[1 - m]->y[rest] + tau * l.points[m]->y[move], kWindowPoint * span_, tau};
    };
    node.covered = search.find_or_spare(at(swept_.tau0), at(swept_.tau1)).has_value();
    if (!node.covered) continue;
    for (std::uint32_t r = node.first_ray; r < node.last_ray; ++r)
      if (rays[r].touch == kNone) (rays[r].out ? head_ray : tail_ray)[rays[r].piece] = kNone;
  }
}

// Sorts touches by piece, each once; the rays in which they arrive and leave, by vertices.
Window::NodeRays Window::take_touches() {
  std::vector<std::uint32_t> order(touches.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
  const auto key = [&](std::uint32_t k) { return std::tuple{touches[k].piece, touch_pair_[k].p, touch_pair_[k].q}; };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  order.erase(
      std::unique(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) == key(b); }),
      order.end());
  std::vector<PersistentTouch> kept;
  NodeRays at;
  for (const std::uint32_t k : order) {
    const auto id = static_cast<std::uint32_t>(kept.size());
    kept.push_back(touches[k]);
    auto& list = at[{touch_pair_[k].p, touch_pair_[k].q}];
    list.push_back({touches[k].piece, id, false, 0});
    list.push_back({touches[k].piece, id, true, 0});
  }
  touches = std::move(kept);
  touch_pair_ = {};
  first_touch.assign(pieces.size() + 1, 0);
  for (const PersistentTouch& t : touches) ++first_touch[t.piece + 1];
  for (std::size_t i = 0; i < pieces.size(); ++i) first_touch[i + 1] += first_touch[i];
  return at;
}

// Pieces that begin or end in a node.
void Window::add_end_rays(NodeRays& at) const {
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].covered) continue;
    const WalkPair start = segments[pieces[i].segment].start, end = end_pair(pieces[i]);
    if (!pieces[i].head_cut)
      if (const auto it = at.find({start.p, start.q}); it != at.end()) it->second.push_back({i, kNone, true, 0});
    if (!pieces[i].tail_cut)
      if (const auto it = at.find({end.p, end.q}); it != at.end()) it->second.push_back({i, kNone, false, 0});
  }
}

// Counter-clockwise, and numbered by direction.
void Window::sort_rays(std::vector<PersistentNode::Ray>& list) const {
  const auto half = [&](const PersistentNode::Ray& r) {
    const LiveSegment& s = segments[pieces[r.piece].segment];
    return (s.dy > 0 || (s.dy == 0 && s.dx > 0) ? 0 : 1) ^ (r.out ? 0 : 1);
  };
  const auto turn = [&](const PersistentNode::Ray& a, const PersistentNode::Ray& b) {
    if (half(a) != half(b)) return half(a) < half(b) ? -1 : 1;
    return -cross(pieces[a.piece].segment, pieces[b.piece].segment) * (a.out == b.out ? 1 : -1);
  };
  std::sort(list.begin(), list.end(), [&](const PersistentNode::Ray& a, const PersistentNode::Ray& b) {
    const int c = turn(a, b);
    return c != 0 ? c < 0 : std::tie(a.piece, a.out) < std::tie(b.piece, b.out);
  });
  std::uint32_t group = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (k > 0 && turn(list[k - 1], list[k]) != 0) ++group;
    list[k].group = group;
  }
}

void Window::add_node(WalkPair at, const std::vector<PersistentNode::Ray>& list) {
  const auto id = static_cast<std::uint32_t>(nodes.size());
  PersistentNode node;
  node.at = at;
  node.first_ray = static_cast<std::uint32_t>(rays.size());
  for (const PersistentNode::Ray& r : list) {
    const auto ray = static_cast<std::uint32_t>(rays.size());
    if (r.touch != kNone) {
      PersistentTouch& t = touches[r.touch];
      t.node = id;
      (r.out ? t.out_ray : t.in_ray) = ray;
    } else {
      (r.out ? head_ray : tail_ray)[r.piece] = ray;
      node.hands_on |= !r.out && pieces[r.piece].handed_on;
    }
    rays.push_back(r);
    node_of_ray.push_back(id);
  }
  node.last_ray = static_cast<std::uint32_t>(rays.size());
  nodes.push_back(node);
  // Something that arrives along a ray on which something leaves: covered from both sides.
  for (std::uint32_t a = node.first_ray; a + 1 < node.last_ray; ++a)
    for (std::uint32_t b = a + 1; b < node.last_ray && rays[b].group == rays[a].group; ++b)
      if (rays[a].out != rays[b].out) folds.push_back({pieces[rays[a].piece].segment, pieces[rays[b].piece].segment});
}

void Window::drop_pairs_through_nodes() {
  std::set<std::pair<std::uint32_t, std::uint32_t>> together;
  for (const PersistentNode& node : nodes)
    for (std::uint32_t a = node.first_ray; a < node.last_ray; ++a)
      for (std::uint32_t b = a + 1; b < node.last_ray; ++b)
        if (rays[a].touch != kNone && rays[b].touch != kNone && rays[a].piece != rays[b].piece)
          together.insert(std::minmax(rays[a].piece, rays[b].piece));
  if (together.empty()) return;
  std::erase_if(candidates, [&](const Candidate& c) {
    if (c.sign == 0 || !together.contains(std::minmax(c.a, c.b))) return false;
    touching.push_back({pieces[c.a].segment, pieces[c.b].segment});
    return true;
  });
}

void Window::index_candidates() {
  const std::size_t n = pieces.size();
  first_of.assign(n + 1, 0);
  for (const Candidate& c : candidates) {
    ++first_of[c.a + 1];
    ++first_of[c.b + 1];
  }
  for (std::size_t i = 0; i < n; ++i) first_of[i + 1] += first_of[i];
  of.resize(first_of[n]);
  std::vector<std::uint32_t> fill(first_of.begin(), first_of.end() - 1);
  for (std::uint32_t c = 0; c < candidates.size(); ++c) {
    of[fill[candidates[c].a]++] = c;
    of[fill[candidates[c].b]++] = c;
  }
}

}  // namespace dymsum::planar
