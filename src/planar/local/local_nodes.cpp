#include "planar/local/local_nodes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dymsum::planar {

namespace {

constexpr double kEndOff = 2 * PosedRegions::kOff;
/// Below this sine of the angle of two lines their crossing is rounded from integers.
constexpr double kSteep = 0x1p-8;
/// Of a difference of two ends in pairs of doubles.
constexpr double kPairGap = 4 * PosedRegions::kPairOff;

Point minus(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }

/// a x b, and the sign where it is sure for vectors whose components are off by at most 2 kEndOff.
int sure_cross(Point a, Point b) {
  const double value = a.x * b.y - a.y * b.x, off = 2 * kEndOff;
  const double error = 2 * off * (std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y) + 2 * off);
  return value > error ? 1 : value < -error ? -1 : 0;
}

/// a x b for vectors whose components are at most 4 and off by kPairGap: how far it is off.
double pair_cross_off(const PairPoint& a, const PairPoint& b) {
  return 8 * kPairGap * (std::abs(a.x.high) + std::abs(a.y.high) + std::abs(b.x.high) + std::abs(b.y.high) + kPairGap);
}
int sure_cross(const PairPoint& a, const PairPoint& b) {
  const double value = planar::cross(a, b).value(), off = pair_cross_off(a, b);
  return value > off ? 1 : value < -off ? -1 : 0;
}

}  // namespace

LocalNodes::LocalNodes(const PosedRegions& posed, const LocalWalls& walls, base::CountedArray<WalkSegment> segments)
    : posed_(posed), walls_(walls), segments_(std::move(segments)), along_(segments_.size()) {
  ends_.reserve(segments_.size());
  for (std::uint32_t s = 0; s < segments_.size(); ++s) {
    const WalkSegment& w = segments_[s];
    const Point v = posed.vertex(1 - w.side, w.vertex), a = posed.vertex(w.side, w.edge),
                b = posed.vertex(w.side, posed.operand(w.side).next[w.edge]);
    ends_.push_back({{a.x + v.x, a.y + v.y}, {b.x + v.x, b.y + v.y}});
    for (const std::uint32_t end : {0U, 1U}) {
      const Point at = end == 0 ? ends_[s].a : ends_[s].b;
      along_[s].push_back(static_cast<std::uint32_t>(nodes_.size()));
      nodes_.push_back({LocalNode::Kind::end, at.x, at.y, kEndOff, s, end});
    }
  }
  pair_ends_.resize(segments_.size());
  find_meetings();
  for (std::uint32_t s = 0; s < segments_.size(); ++s) add_walls(s);
  exact_.resize(nodes_.size());
  pair_places_.resize(nodes_.size());
  merge_same();
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) place_in_boxes(nodes_[n], n);
  for (std::uint32_t s = 0; s < segments_.size(); ++s) sort_along(s);
}

BigPoint LocalNodes::exact_end(std::uint32_t s, int end) const {
  const WalkSegment& w = segments_[s];
  const std::uint32_t walk = end == 0 ? w.edge : posed_.operand(w.side).next[w.edge];
  return posed_.exact(w.side, walk) + posed_.exact(1 - w.side, w.vertex);
}

const LocalNodes::PairEnds& LocalNodes::pair_ends(std::uint32_t s) const {
  std::optional<PairEnds>& kept = pair_ends_[s];
  if (!kept) {
    const WalkSegment& w = segments_[s];
    const PairPoint& v = posed_.pair(1 - w.side, w.vertex);
    kept = PairEnds{posed_.pair(w.side, w.edge) + v, posed_.pair(w.side, posed_.operand(w.side).next[w.edge]) + v};
  }
  return *kept;
}

int LocalNodes::direction(std::uint32_t s, int axis) const {
  const Point d = ends_[s].d();
  const double v = axis == 0 ? d.x : d.y;
  if (std::abs(v) > 4 * kEndOff) return v > 0 ? 1 : -1;
  const BigPoint exact = exact_direction(s);
  return sign(axis == 0 ? exact.x : exact.y);
}

int LocalNodes::cross(std::uint32_t s, std::uint32_t t) const {
  if (const int sure = sure_cross(ends_[s].d(), ends_[t].d())) return sure;
  const PairEnds &a = pair_ends(s), &b = pair_ends(t);
  if (const int sure = sure_cross(a[1] - a[0], b[1] - b[0])) return sure;
  return sign(planar::cross(exact_direction(s), exact_direction(t)));
}

/// The side of the line of s on which an end of t lies: 1 is its left.
int LocalNodes::side(std::uint32_t s, std::uint32_t t, int end) const {
  const Point v = end == 0 ? ends_[t].a : ends_[t].b;
  if (const int sure = sure_cross(ends_[s].d(), minus(v, ends_[s].a))) return sure;
  const PairEnds& a = pair_ends(s);
  if (const int sure = sure_cross(a[1] - a[0], pair_ends(t)[static_cast<std::size_t>(end)] - a[0])) return sure;
  return sign(planar::cross(exact_direction(s), exact_end(t, end) - exact_end(s, 0)));
}

void LocalNodes::find_meetings() {
  std::vector<std::uint32_t> order(segments_.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto low = [&](std::uint32_t s) { return std::min(ends_[s].a.x, ends_[s].b.x); };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t s, std::uint32_t t) { return low(s) != low(t) ? low(s) < low(t) : s < t; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Ends& a = ends_[order[i]];
    const double right = std::max(a.a.x, a.b.x) + 2 * kEndOff;
    const double bottom = std::min(a.a.y, a.b.y) - 2 * kEndOff, top = std::max(a.a.y, a.b.y) + 2 * kEndOff;
    for (std::size_t j = i + 1; j < order.size() && low(order[j]) <= right; ++j) {
      const Ends& b = ends_[order[j]];
      if (std::max(b.a.y, b.b.y) >= bottom && std::min(b.a.y, b.b.y) <= top)
        meet(std::min(order[i], order[j]), std::max(order[i], order[j]));
    }
  }
}

void LocalNodes::meet(std::uint32_t s, std::uint32_t t) {
  const int t0 = side(s, t, 0), t1 = side(s, t, 1);
  if (t0 * t1 > 0) return;
  if (t0 == 0 && t1 == 0) return meet_on_one_line(s, t);
  const int s0 = side(t, s, 0), s1 = side(t, s, 1);
  if (s0 * s1 > 0) return;
  if (t0 * t1 < 0 && s0 * s1 < 0) return add_crossing(s, t);
  // An end of one lies on the other.
  if (t0 == 0) along_[s].push_back(2 * t);
  if (t1 == 0) along_[s].push_back(2 * t + 1);
  if (s0 == 0) along_[t].push_back(2 * s);
  if (s1 == 0) along_[t].push_back(2 * s + 1);
}

void LocalNodes::meet_on_one_line(std::uint32_t s, std::uint32_t t) {
  for (const int end : {0, 1}) {
    if (between_ends(s, t, end)) along_[s].push_back(2 * t + static_cast<std::uint32_t>(end));
    if (between_ends(t, s, end)) along_[t].push_back(2 * s + static_cast<std::uint32_t>(end));
  }
}

/// Whether an end of t, which lies on the line of s, lies on s.
bool LocalNodes::between_ends(std::uint32_t s, std::uint32_t t, int end) const {
  const BigPoint a = exact_end(s, 0), b = exact_end(s, 1), v = exact_end(t, end);
  return sign(dot(b - a, v - a)) >= 0 && sign(dot(b - a, b - v)) >= 0;
}

/// Lines are off by less than 2 kEndOff near their segments, so their crossing by less than that over the sine.
void LocalNodes::add_crossing(std::uint32_t s, std::uint32_t t) {
  const Point d = ends_[s].d(), e = ends_[t].d(), gap = minus(ends_[t].a, ends_[s].a);
  const double area = d.x * e.y - d.y * e.x, sizes = std::hypot(d.x, d.y) * std::hypot(e.x, e.y);
  LocalNode node{LocalNode::Kind::crossing, 0, 0, 0, s, t};
  const double area_off = 4 * kEndOff * (std::abs(d.x) + std::abs(d.y) + std::abs(e.x) + std::abs(e.y));
  if (std::abs(area) > kSteep * sizes && std::abs(area) > 16 * area_off) {
    const double share = std::clamp((gap.x * e.y - gap.y * e.x) / area, 0.0, 1.0);
    node.x = ends_[s].a.x + share * d.x, node.y = ends_[s].a.y + share * d.y;
    node.off = 8 * kEndOff * sizes / std::abs(area);
    const ScaledBox reach = walls_.reach();
    if (node.x + node.off < reach.x0 || node.x - node.off > reach.x1 || node.y + node.off < reach.y0 ||
        node.y - node.off > reach.y1)
      return;
  } else {
    const Point at = posed_.scaled(make_exact(node));
    node.x = at.x, node.y = at.y, node.off = kEndOff;
  }
  const auto n = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node);
  along_[s].push_back(n), along_[t].push_back(n);
}

/// The sign of an end's coordinate less the wall's.
int LocalNodes::beyond(std::uint32_t s, int end, const LocalWall& wall) const {
  const Point v = end == 0 ? ends_[s].a : ends_[s].b;
  const double gap = (wall.axis == 0 ? v.x : v.y) - wall.scaled;
  if (std::abs(gap) > 2 * kEndOff) return gap > 0 ? 1 : -1;
  const BigPoint exact = exact_end(s, end);
  return sign((wall.axis == 0 ? exact.x - wall.exact.x : exact.y - wall.exact.y));
}

void LocalNodes::add_walls(std::uint32_t s) {
  for (std::uint32_t k = 0; k < walls_.all().size(); ++k) {
    const LocalWall& wall = walls_.all()[k];
    if (wall.beyond || beyond(s, 0, wall) * beyond(s, 1, wall) >= 0) continue;
    LocalNode node{LocalNode::Kind::wall, 0, 0, 0, s, k};
    const Point at = posed_.scaled(make_exact(node));
    node.x = at.x, node.y = at.y, node.off = kEndOff;
    along_[s].push_back(static_cast<std::uint32_t>(nodes_.size()));
    nodes_.push_back(node);
  }
}

BigPlace LocalNodes::make_exact(const LocalNode& node) const {
  const BigPoint a = exact_end(node.a, 0), d = exact_direction(node.a);
  if (node.kind == LocalNode::Kind::end) {
    const BigPoint at = exact_end(node.a, static_cast<int>(node.b));
    return {at.x, at.y, Big::from_int64(1)};
  }
  // a + d n / w
  Big n, w;
  if (node.kind == LocalNode::Kind::wall) {
    const LocalWall& wall = walls_.all()[node.b];
    n = wall.axis == 0 ? wall.exact.x - a.x : wall.exact.y - a.y, w = wall.axis == 0 ? d.x : d.y;
  } else {
    const BigPoint e = exact_direction(node.b);
    n = planar::cross(exact_end(node.b, 0) - a, e), w = planar::cross(d, e);
  }
  if (sign(w) < 0) n = -n, w = -w;
  return {a.x * w + d.x * n, a.y * w + d.y * n, w};
}

const BigPlace& LocalNodes::exact(std::uint32_t n) const {
  if (!exact_[n]) exact_[n] = make_exact(nodes_[n]);
  return *exact_[n];
}

// Ends are off by 2 kPairOff, as sums. A share n / w of at most 1 is off by what n and w are, over w, and by roundings.
LocalNodes::PairPlace LocalNodes::make_pair_place(const LocalNode& node) const {
  const PairEnds& ends = pair_ends(node.a);
  if (node.kind == LocalNode::Kind::end) return {ends[node.b], 2 * PosedRegions::kPairOff};
  const PairPoint d = ends[1] - ends[0];
  base::DoublePair n, w;
  double off = 0;
  if (node.kind == LocalNode::Kind::wall) {
    const LocalWall& wall = walls_.all()[node.b];
    n = posed_.pair(wall.axis == 0 ? wall.exact.x : wall.exact.y) - (wall.axis == 0 ? ends[0].x : ends[0].y);
    w = wall.axis == 0 ? d.x : d.y;
    off = 4 * kPairGap;
  } else {
    const PairEnds& others = pair_ends(node.b);
    const PairPoint e = others[1] - others[0], gap = others[0] - ends[0];
    n = planar::cross(gap, e);
    w = planar::cross(d, e);
    off = 2 * std::max(pair_cross_off(gap, e), pair_cross_off(d, e));
  }
  if (!(std::abs(w.high) > 4 * off)) return {ends[0], INFINITY};
  const base::DoublePair share = n / w;
  const double size = std::abs(d.x.high) + std::abs(d.y.high);
  return {{ends[0].x + d.x * share, ends[0].y + d.y * share}, 4 * off / std::abs(w.high) * size + 4 * kPairGap};
}

const LocalNodes::PairPlace& LocalNodes::pair_place(std::uint32_t n) const {
  std::optional<PairPlace>& kept = pair_places_[n];
  if (!kept) kept = make_pair_place(nodes_[n]);
  return *kept;
}

/// The sign of m less n along an axis, 0 where pairs of doubles do not tell.
int LocalNodes::pair_order(std::uint32_t m, std::uint32_t n, int axis) const {
  const PairPlace &a = pair_place(m), &b = pair_place(n);
  const double gap = (axis == 0 ? a.at.x - b.at.x : a.at.y - b.at.y).value(), off = (a.off + b.off) * (1 + 0x1p-40);
  return gap > off ? 1 : gap < -off ? -1 : 0;
}

/// Nodes that doubles do not tell apart are compared exactly; each takes the number of the first that is the same.
void LocalNodes::merge_same() {
  std::vector<std::uint32_t> order(nodes_.size()), same(nodes_.size());
  std::iota(order.begin(), order.end(), 0U), std::iota(same.begin(), same.end(), 0U);
  double widest = 0;
  for (const LocalNode& node : nodes_) widest = std::max(widest, node.off);
  std::sort(order.begin(), order.end(), [&](std::uint32_t m, std::uint32_t n) { return nodes_[m].x < nodes_[n].x; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const LocalNode& a = nodes_[order[i]];
    for (std::size_t j = i + 1; j < order.size() && nodes_[order[j]].x <= a.x + a.off + widest; ++j) {
      const LocalNode& b = nodes_[order[j]];
      std::uint32_t &m = same[order[i]], &n = same[order[j]];
      const double off = a.off + b.off;
      if (m == n || b.x - a.x > off || std::abs(b.y - a.y) > off) continue;
      if (pair_order(order[i], order[j], 0) != 0 || pair_order(order[i], order[j], 1) != 0) continue;
      if (!same_place(exact(order[i]), exact(order[j]))) continue;
      // All that are known to be the same have one number.
      const std::uint32_t less = std::min(m, n), more = std::max(m, n);
      for (std::uint32_t& number : same)
        if (number == more) number = less;
    }
  }
  for (std::vector<std::uint32_t>& list : along_)
    for (std::uint32_t& n : list) n = same[n];
}

void LocalNodes::place_in_boxes(LocalNode& node, std::uint32_t n) {
  node.in_box = node.known = true;
  for (std::uint32_t k = 0; k < walls_.all().size(); ++k) {
    const LocalWall& wall = walls_.all()[k];
    const int inward = k % 2 == 0 ? 1 : -1;
    const double gap = ((wall.axis == 0 ? node.x : node.y) - wall.scaled) * inward, off = node.off + kEndOff;
    if (k >= 4) {
      node.known = node.known && gap > off;
    } else if (gap < -off) {
      node.in_box = false;
    } else if (gap <= off && node.in_box) {
      node.in_box = compare(exact(n), wall.exact, wall.axis) * inward >= 0;
    }
  }
}

void LocalNodes::sort_along(std::uint32_t s) {
  const Point d = ends_[s].d();
  const int axis = std::abs(d.x) >= std::abs(d.y) ? 0 : 1;
  std::vector<std::uint32_t>& list = along_[s];
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  const int ahead = direction(s, axis) != 0 ? direction(s, axis) : direction(s, 1 - axis);
  const int by = direction(s, axis) != 0 ? axis : 1 - axis;
  std::sort(list.begin(), list.end(), [&](std::uint32_t m, std::uint32_t n) {
    const LocalNode &a = nodes_[m], &b = nodes_[n];
    const double gap = (by == 0 ? b.x - a.x : b.y - a.y) * ahead;
    if (std::abs(gap) > a.off + b.off) return gap > 0;
    if (m == n) return false;
    const int known = pair_order(m, n, by);
    return (known != 0 ? known : compare(exact(m), exact(n), by)) * ahead < 0;
  });
}

}  // namespace dymsum::planar
