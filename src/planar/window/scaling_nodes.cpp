#include "planar/window/scaling_stages.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "planar/window/edge_search.h"

namespace dymsum::planar {

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
