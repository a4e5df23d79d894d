#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "planar/window/scaling_pairs.h"
#include "planar/window/window_builder.h"

namespace dymsum::planar {
namespace {

// Of two such pieces one covers the other, or the one that ends first is handed on to the other where that begins. Each
// position stays covered: of the pieces through it take the one that ends last (of those the one that begins first);
// what stops it there would have to end later. Orders have to be proved throughout the window; where they are not, both
// pieces stay as they are.
class SharedLines {
 public:
  SharedLines(Window& window, TouchFinder& touches) : window_(window), touches_(touches) {}
  void settle(PiecePairs& close);

 private:
  struct Stop {
    std::uint32_t piece, at;  ///< a piece, and one that begins inside it
    Linear position;
  };
  void hand_on(const std::vector<Stop>& stops, PiecePairs& close);
  bool along_always(std::uint32_t i, std::uint32_t j);
  std::array<Linear, 2> ends_on(std::uint32_t piece, std::uint32_t other) const;
  double error_along(std::uint32_t piece) const;
  bool provably_before(const Linear& a, const Linear& b, double error) const;
  bool covers(std::uint32_t i, std::uint32_t j) const;
  std::optional<Linear> begins_inside(std::uint32_t i, std::uint32_t j) const;

  Window& window_;
  TouchFinder& touches_;
};

// Whether two pieces lie on one line at every scale, the same way.
bool SharedLines::along_always(std::uint32_t i, std::uint32_t j) {
  const std::uint32_t si = window_.pieces[i].segment, sj = window_.pieces[j].segment;
  const LiveSegment &a = window_.segments[si], &b = window_.segments[sj];
  const double u = a.dx * b.dy, v = a.dy * b.dx;
  if (std::abs(u - v) > kScaledEdgeCross * (std::abs(u) + std::abs(v)) || a.dx * b.dx + a.dy * b.dy < 0) return false;
  const double error = kWindowSide * window_.span() * (std::abs(a.dx) + std::abs(a.dy));
  for (const double tau : {window_.frame().tau0, window_.frame().tau1}) {
    const double side = (b.x.at(tau) - a.x.at(tau)) * a.dy - (b.y.at(tau) - a.y.at(tau)) * a.dx;
    if (std::abs(side) > error) return false;
  }
  return window_.cross(si, sj) == 0 && touches_.always_on(si, window_.exact(b.start));
}

double SharedLines::error_along(std::uint32_t piece) const {
  const LiveSegment& on = window_.segments[window_.pieces[piece].segment];
  const double length = on.dx * on.dx + on.dy * on.dy;
  return kProjectedGap * window_.span() * (std::abs(on.dx) + std::abs(on.dy)) / length +
         kProjectionGap * std::max(1.0, window_.frame().tau1);
}

// The parameters at which another piece on the same line begins and ends, in multiples of this one's edge vector.
// Requires: neither has been handed on.
std::array<Linear, 2> SharedLines::ends_on(std::uint32_t piece, std::uint32_t other) const {
  const LiveSegment &on = window_.segments[window_.pieces[piece].segment],
                    &s = window_.segments[window_.pieces[other].segment];
  const double length = on.dx * on.dx + on.dy * on.dy;
  const auto position = [&](const Linear& t) {
    const double ax = s.x.a + t.a * s.dx - on.x.a, ay = s.y.a + t.a * s.dy - on.y.a, bx = s.x.b + t.b * s.dx - on.x.b,
                 by = s.y.b + t.b * s.dy - on.y.b;
    return Linear{(ax * on.dx + ay * on.dy) / length, (bx * on.dx + by * on.dy) / length};
  };
  return {position(window_.pieces[other].head_cut ? window_.pieces[other].head : Linear{}),
          position(window_.end_position(window_.pieces[other]))};
}

// Linear in tau: what holds at both ends of the window holds throughout.
bool SharedLines::provably_before(const Linear& a, const Linear& b, double error) const {
  return b.at(window_.frame().tau0) - a.at(window_.frame().tau0) > error &&
         b.at(window_.frame().tau1) - a.at(window_.frame().tau1) > error;
}

// Whether piece i covers piece j throughout the window; of two that are equal the first one does.
bool SharedLines::covers(std::uint32_t i, std::uint32_t j) const {
  const Piece &a = window_.pieces[i], &b = window_.pieces[j];
  const auto [start, end] = ends_on(i, j);
  const double error = error_along(i);
  const bool same_start =
      !a.head_cut && !b.head_cut && window_.segments[a.segment].start == window_.segments[b.segment].start;
  const bool same_end =
      !a.tail_cut && !b.tail_cut && window_.segments[a.segment].end == window_.segments[b.segment].end;
  if (same_start && same_end) return i < j;
  return (same_start || provably_before(a.head_cut ? a.head : Linear{}, start, error)) &&
         (same_end || provably_before(end, window_.end_position(a), error));
}

// The parameter at which piece i ends if j begins inside it and ends after it throughout the window: there.
std::optional<Linear> SharedLines::begins_inside(std::uint32_t i, std::uint32_t j) const {
  const Piece &a = window_.pieces[i], &b = window_.pieces[j];
  if (a.tail_cut || b.head_cut) return std::nullopt;
  const auto [from, to] = ends_on(i, j);
  const Linear start = a.head_cut ? a.head : Linear{}, end = window_.end_position(a);
  const double error = error_along(i);
  if (!provably_before(start, from, error) || !provably_before(from, end, error) || !provably_before(end, to, error))
    return std::nullopt;
  return from;
}

void SharedLines::settle(PiecePairs& close) {
  PiecePairs along;
  std::erase_if(close, [&](const std::array<std::uint32_t, 2>& pair) {
    const bool is = along_always(pair[0], pair[1]);
    if (is) along.push_back(pair);
    return is;
  });
  if (along.empty()) return;
  for (const auto& [i, j] : along) {
    window_.touching.push_back({window_.pieces[i].segment, window_.pieces[j].segment});
    if (covers(i, j)) window_.pieces[j].covered = true;
    else if (covers(j, i)) window_.pieces[i].covered = true;
  }
  std::vector<Stop> stops;
  for (const auto& [i, j] : along) {
    if (window_.pieces[i].covered || window_.pieces[j].covered) continue;
    if (const auto position = begins_inside(i, j)) stops.push_back({i, j, *position});
    else if (const auto other = begins_inside(j, i)) stops.push_back({j, i, *other});
    else close.push_back({i, j});
  }
  hand_on(stops, close);
  std::erase_if(close, [&](const std::array<std::uint32_t, 2>& pair) {
    const Piece &a = window_.pieces[pair[0]], &b = window_.pieces[pair[1]];
    if (a.covered || b.covered || a.handed_on || b.handed_on) window_.touching.push_back({a.segment, b.segment});
    return a.covered || b.covered;
  });
}

// Each piece ends at the first of its stops. Where it is not certain which one is first, any will do, and the others
// stay open.
void SharedLines::hand_on(const std::vector<Stop>& stops, PiecePairs& close) {
  for (const Stop& s : stops) {
    Piece& p = window_.pieces[s.piece];
    const double error = error_along(s.piece);
    if (p.handed_on && !provably_before(s.position, p.tail, error)) continue;
    p.handed_on = true;
    p.tail = s.position;
    p.tail_error = error;
    p.tail_at = window_.segments[window_.pieces[s.at].segment].start;
  }
  for (const Stop& s : stops) {
    const Piece& p = window_.pieces[s.piece];
    if (p.tail_at == window_.segments[window_.pieces[s.at].segment].start ||
        provably_before(p.tail, s.position, p.tail_error))
      continue;
    close.push_back({std::min(s.piece, s.at), std::max(s.piece, s.at)});
  }
}

}  // namespace

void share_lines(Window& window, TouchFinder& touches, PiecePairs& close) {
  SharedLines(window, touches).settle(close);
}

bool TouchFinder::always_on(std::uint32_t segment, Pair v) {
  const OperandPair& base = window_.base();
  const Segment s = window_.exact(segment);
  if (base.lattice->side(s, v) != 0) return false;
  if (doubled_ == nullptr) {
    const ScaleValue two = scale_value(exact::BigRational(2));
    doubled_ = base.lattice_at(base.lattice_scale(two));
  }
  return doubled_->side(s, v) == 0;
}

bool TouchFinder::touch_always(const Candidate& c, std::array<bool, 2> at_a, std::array<bool, 2> at_b) {
  const std::uint32_t si = window_.pieces[c.a].segment, sj = window_.pieces[c.b].segment;
  const LiveSegment &a = window_.segments[si], &b = window_.segments[sj];
  const WalkPair end_a = window_.end_pair(window_.pieces[c.a]), end_b = window_.end_pair(window_.pieces[c.b]);
  const bool start_a = at_a[0] && always_on(sj, window_.exact(a.start)),
             start_b = at_b[0] && always_on(si, window_.exact(b.start));
  const bool a_on_b = start_a || (at_a[1] && always_on(sj, window_.exact(end_a))),
             b_on_a = start_b || (at_b[1] && always_on(si, window_.exact(end_b)));
  if (!a_on_b && !b_on_a) return false;
  window_.touching.push_back({si, sj});
  if (a_on_b && b_on_a) window_.folds.push_back({si, sj});
  else if (a_on_b) add_touch(c.b, start_a ? a.start : end_a, c.tb, c.error_b);
  else add_touch(c.a, start_b ? b.start : end_b, c.ta, c.error_a);
  return true;
}

void TouchFinder::add_touch(std::uint32_t piece, WalkPair v, const Linear& t, double error) {
  Candidate c;
  c.out_low = c.in_low = -INFINITY;
  c.out_high = c.in_high = INFINITY;
  std::array<bool, 2> unsure{};
  if (!narrow_to_piece(window_, piece, t, error, c, unsure) || c.out_high <= window_.frame().tau0 ||
      c.out_low >= window_.frame().tau1)
    return;
  PersistentTouch touch;
  touch.piece = piece;
  touch.t = t;
  touch.error = error;
  touch.out_low = c.out_low;
  touch.in_low = c.in_low;
  touch.in_high = c.in_high;
  touch.out_high = c.out_high;
  window_.touches.push_back(touch);
  pairs_.push_back(v);
}

void TouchFinder::touch_parallel(std::uint32_t i, std::uint32_t j) {
  const std::size_t before = window_.touches.size();
  for (const auto& [on_piece, other] : {std::pair{i, j}, std::pair{j, i}}) {
    const LiveSegment &on = window_.segments[window_.pieces[on_piece].segment],
                      &s = window_.segments[window_.pieces[other].segment];
    const double length = on.dx * on.dx + on.dy * on.dy;
    const double error = kProjectedSums * window_.span() * (std::abs(on.dx) + std::abs(on.dy)) / length +
                         kProjection * std::max(1.0, window_.frame().tau1);
    for (const bool end : {false, true}) {
      const double f = end ? (s.moving ? 0 : 1) : 0,
                   m = end && s.moving ? 1 : 0;  // the end lies one vector further, times tau if it moves
      const double ax = s.x.a + f * s.dx - on.x.a, ay = s.y.a + f * s.dy - on.y.a, bx = s.x.b + m * s.dx - on.x.b,
                   by = s.y.b + m * s.dy - on.y.b;
      add_touch(on_piece, end ? s.end : s.start,
                {(ax * on.dx + ay * on.dy) / length, (bx * on.dx + by * on.dy) / length}, error);
    }
  }
  if (window_.touches.size() == before) return;
  const std::uint32_t si = window_.pieces[i].segment, sj = window_.pieces[j].segment;
  window_.touching.push_back({si, sj});
  // Against each other they cover both sides of a line: a crack, unless inside.
  if (window_.base().lattice->dot(window_.exact(si).edge, window_.exact(sj).edge) < 0)
    window_.folds.push_back({si, sj});
}

namespace {

class NodeMaker {
 public:
  NodeMaker(Window& window, const std::vector<WalkPair>& touch_pairs) : window_(window), touch_pairs_(touch_pairs) {}
  void run();

 private:
  using NodeRays = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<PersistentNode::Ray>>;
  NodeRays take_touches();
  void add_end_rays(NodeRays& at) const;
  void sort_rays(std::vector<PersistentNode::Ray>& list) const;
  void add_node(WalkPair at, const std::vector<PersistentNode::Ray>& list);
  void drop_pairs_through_nodes();

  Window& window_;
  const std::vector<WalkPair>& touch_pairs_;
};

void NodeMaker::run() {
  window_.head_ray.assign(window_.pieces.size(), kNone);
  window_.tail_ray.assign(window_.pieces.size(), kNone);
  NodeRays at = take_touches();
  for (const Piece& p : window_.pieces)
    if (p.handed_on && !p.covered) at[{p.tail_at.p, p.tail_at.q}];
  if (at.empty()) return;
  add_end_rays(at);
  for (auto& [v, list] : at) {
    sort_rays(list);
    add_node({v.first, v.second}, list);
  }
  drop_pairs_through_nodes();
}

// Sorts touches by piece, each once; the rays in which they arrive and leave, by vertices.
NodeMaker::NodeRays NodeMaker::take_touches() {
  std::vector<std::uint32_t> order(window_.touches.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
  const auto key = [&](std::uint32_t k) {
    return std::tuple{window_.touches[k].piece, touch_pairs_[k].p, touch_pairs_[k].q};
  };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  order.erase(
      std::unique(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) == key(b); }),
      order.end());
  std::vector<PersistentTouch> kept;
  NodeRays at;
  for (const std::uint32_t k : order) {
    const auto id = static_cast<std::uint32_t>(kept.size());
    kept.push_back(window_.touches[k]);
    auto& list = at[{touch_pairs_[k].p, touch_pairs_[k].q}];
    list.push_back({window_.touches[k].piece, id, false, 0});
    list.push_back({window_.touches[k].piece, id, true, 0});
  }
  window_.touches = std::move(kept);
  window_.first_touch.assign(window_.pieces.size() + 1, 0);
  for (const PersistentTouch& t : window_.touches) ++window_.first_touch[t.piece + 1];
  for (std::size_t i = 0; i < window_.pieces.size(); ++i) window_.first_touch[i + 1] += window_.first_touch[i];
  return at;
}

// Pieces that begin or end in a node.
void NodeMaker::add_end_rays(NodeRays& at) const {
  for (std::uint32_t i = 0; i < window_.pieces.size(); ++i) {
    if (window_.pieces[i].covered) continue;
    const WalkPair start = window_.segments[window_.pieces[i].segment].start, end = window_.end_pair(window_.pieces[i]);
    if (!window_.pieces[i].head_cut)
      if (const auto it = at.find({start.p, start.q}); it != at.end()) it->second.push_back({i, kNone, true, 0});
    if (!window_.pieces[i].tail_cut)
      if (const auto it = at.find({end.p, end.q}); it != at.end()) it->second.push_back({i, kNone, false, 0});
  }
}

// Counter-clockwise, and numbered by direction.
void NodeMaker::sort_rays(std::vector<PersistentNode::Ray>& list) const {
  const auto half = [&](const PersistentNode::Ray& r) {
    const LiveSegment& s = window_.segments[window_.pieces[r.piece].segment];
    return (s.dy > 0 || (s.dy == 0 && s.dx > 0) ? 0 : 1) ^ (r.out ? 0 : 1);
  };
  const auto turn = [&](const PersistentNode::Ray& a, const PersistentNode::Ray& b) {
    if (half(a) != half(b)) return half(a) < half(b) ? -1 : 1;
    return -window_.cross(window_.pieces[a.piece].segment, window_.pieces[b.piece].segment) * (a.out == b.out ? 1 : -1);
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

void NodeMaker::add_node(WalkPair at, const std::vector<PersistentNode::Ray>& list) {
  const auto id = static_cast<std::uint32_t>(window_.nodes.size());
  PersistentNode node;
  node.at = at;
  node.first_ray = static_cast<std::uint32_t>(window_.rays.size());
  for (const PersistentNode::Ray& r : list) {
    const auto ray = static_cast<std::uint32_t>(window_.rays.size());
    if (r.touch != kNone) {
      PersistentTouch& t = window_.touches[r.touch];
      t.node = id;
      (r.out ? t.out_ray : t.in_ray) = ray;
    } else {
      (r.out ? window_.head_ray : window_.tail_ray)[r.piece] = ray;
      node.hands_on |= !r.out && window_.pieces[r.piece].handed_on;
    }
    window_.rays.push_back(r);
    window_.node_of_ray.push_back(id);
  }
  node.last_ray = static_cast<std::uint32_t>(window_.rays.size());
  window_.nodes.push_back(node);
  // Something that arrives along a ray on which something leaves: covered from both sides.
  for (std::uint32_t a = node.first_ray; a + 1 < node.last_ray; ++a)
    for (std::uint32_t b = a + 1; b < node.last_ray && window_.rays[b].group == window_.rays[a].group; ++b)
      if (window_.rays[a].out != window_.rays[b].out)
        window_.folds.push_back(
            {window_.pieces[window_.rays[a].piece].segment, window_.pieces[window_.rays[b].piece].segment});
}

void NodeMaker::drop_pairs_through_nodes() {
  std::set<std::pair<std::uint32_t, std::uint32_t>> together;
  for (const PersistentNode& node : window_.nodes)
    for (std::uint32_t a = node.first_ray; a < node.last_ray; ++a)
      for (std::uint32_t b = a + 1; b < node.last_ray; ++b)
        if (window_.rays[a].touch != kNone && window_.rays[b].touch != kNone &&
            window_.rays[a].piece != window_.rays[b].piece)
          together.insert(std::minmax(window_.rays[a].piece, window_.rays[b].piece));
  if (together.empty()) return;
  std::erase_if(window_.candidates, [&](const Candidate& c) {
    if (c.sign == 0 || !together.contains(std::minmax(c.a, c.b))) return false;
    window_.touching.push_back({window_.pieces[c.a].segment, window_.pieces[c.b].segment});
    return true;
  });
}

}  // namespace

void make_nodes(Window& window, const std::vector<WalkPair>& touch_pairs) { NodeMaker(window, touch_pairs).run(); }

void drop_covered_nodes(Window& window, const WindowFrame& swept) {
  if (window.nodes.empty()) return;
  EdgeSearch search(window);
  for (PersistentNode& node : window.nodes) {
    const MovingPoint position = window.position(node.at);
    const auto at = [&](double tau) {
      return EdgeSearch::Position{position.x.at(tau), position.y.at(tau), kWindowPoint * window.span(), tau};
    };
    node.covered = search.find_or_spare(at(swept.tau0), at(swept.tau1)).has_value();
    if (!node.covered) continue;
    for (std::uint32_t r = node.first_ray; r < node.last_ray; ++r)
      if (window.rays[r].touch == kNone)
        (window.rays[r].out ? window.head_ray : window.tail_ray)[window.rays[r].piece] = kNone;
  }
}

}  // namespace dymsum::planar
