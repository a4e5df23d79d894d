#include "planar/frame/local_nodes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dymsum::planar {

namespace {

constexpr double kEndOff = 2 * PosedRegions::kOff;
/// The sine of the angle of two lines below which their crossing is rounded from integers.
constexpr double kSteep = 0x1p-8;
/// The error of a difference of two ends in pairs of doubles.
constexpr double kPairGap = 4 * PosedRegions::kPairOff;
/// The error of the double of a pair, and of a product or a sum of doubles: more than twice its rounding.
constexpr double kTwice = 0x1p-50;

/// a x b for vectors whose components are at most 4 and off by kPairGap: how far it is off.
double pair_cross_off(const PairPoint& a, const PairPoint& b) {
  return 8 * kPairGap * (std::abs(a.x.high) + std::abs(a.y.high) + std::abs(b.x.high) + std::abs(b.y.high) + kPairGap);
}
int proved_cross(const PairPoint& a, const PairPoint& b) {
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
  pair_positions_.resize(nodes_.size());
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

/// The vertices whose sum an end is.
Pair LocalNodes::end_name(std::uint32_t s, std::uint32_t end) const {
  const WalkSegment& w = segments_[s];
  const std::uint32_t walk = end == 0 ? w.edge : posed_.operand(w.side).next[w.edge];
  return w.side == 0 ? Pair{walk, w.vertex} : Pair{w.vertex, walk};
}

int LocalNodes::direction(std::uint32_t s, int axis) const {
  const Point d = ends_[s].d();
  const double v = axis == 0 ? d.x : d.y;
  if (std::abs(v) > 4 * kEndOff) return v > 0 ? 1 : -1;
  const BigPoint exact = exact_direction(s);
  return sign(axis == 0 ? exact.x : exact.y);
}

int LocalNodes::cross(std::uint32_t s, std::uint32_t t) const {
  if (const int proved = proved_cross(ends_[s].d(), ends_[t].d(), 2 * kEndOff)) return proved;
  const PairEnds &a = pair_ends(s), &b = pair_ends(t);
  if (const int proved = proved_cross(a[1] - a[0], b[1] - b[0])) return proved;
  return sign(planar::cross(exact_direction(s), exact_direction(t)));
}

/// The side of the line of s on which an end of t lies: 1 is its left.
int LocalNodes::side(std::uint32_t s, std::uint32_t t, int end) const {
  const Point v = end == 0 ? ends_[t].a : ends_[t].b;
  if (const int proved = proved_cross(ends_[s].d(), less(v, ends_[s].a), 2 * kEndOff)) return proved;
  const Pair name = end_name(t, static_cast<std::uint32_t>(end));
  if (name == end_name(s, 0) || name == end_name(s, 1)) return 0;
  const PairEnds& a = pair_ends(s);
  if (const int proved = proved_cross(a[1] - a[0], pair_ends(t)[static_cast<std::size_t>(end)] - a[0])) return proved;
  return sign(planar::cross(exact_direction(s), exact_end(t, end) - exact_end(s, 0)));
}

void LocalNodes::find_meetings() {
  std::vector<std::uint32_t> order(segments_.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto low = [&](std::uint32_t s) { return std::min(ends_[s].a.x, ends_[s].b.x); };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t s, std::uint32_t t) { return low(s) != low(t) ? low(s) < low(t) : s < t; });
  // Where they meet outside of the larger box does not matter.
  const ScaledBox reach = walls_.reach();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Ends& a = ends_[order[i]];
    const double right = std::min(std::max(a.a.x, a.b.x), reach.x1) + 2 * kEndOff;
    const double bottom = std::max(std::min(a.a.y, a.b.y), reach.y0) - 2 * kEndOff,
                 top = std::min(std::max(a.a.y, a.b.y), reach.y1) + 2 * kEndOff;
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
  const Point d = ends_[s].d(), e = ends_[t].d(), gap = less(ends_[t].a, ends_[s].a);
  const double area = d.x * e.y - d.y * e.x, sizes = std::hypot(d.x, d.y) * std::hypot(e.x, e.y);
  LocalNode node{LocalNode::Kind::crossing, 0, 0, 0, s, t};
  const double area_off = 4 * kEndOff * (std::abs(d.x) + std::abs(d.y) + std::abs(e.x) + std::abs(e.y));
  if (std::abs(area) > kSteep * sizes && std::abs(area) > 16 * area_off) {
    const double fraction = std::clamp((gap.x * e.y - gap.y * e.x) / area, 0.0, 1.0);
    node.x = ends_[s].a.x + fraction * d.x, node.y = ends_[s].a.y + fraction * d.y;
    node.off = 8 * kEndOff * sizes / std::abs(area);
    const ScaledBox reach = walls_.reach();
    if (node.x + node.off < reach.x0 || node.x - node.off > reach.x1 || node.y + node.off < reach.y0 ||
        node.y - node.off > reach.y1)
      return;
  } else {
    place_finely(node);
  }
  const auto n = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node);
  along_[s].push_back(n), along_[t].push_back(n);
}

/// Pairs of doubles place the node, or integers.
void LocalNodes::place_finely(LocalNode& node) const {
  node.off = kEndOff;
  if (const PairPosition fine = make_pair_position(node); fine.off < kEndOff / 2) {
    const auto [x, y] = posed_.scaled(fine.at);
    node.x = x, node.y = y;
    return;
  }
  const Point at = posed_.scaled(make_exact(node));
  node.x = at.x, node.y = at.y;
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
    place_finely(node);
    along_[s].push_back(static_cast<std::uint32_t>(nodes_.size()));
    nodes_.push_back(node);
  }
}

BigPosition LocalNodes::make_exact(const LocalNode& node) const {
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

const BigPosition& LocalNodes::exact(std::uint32_t n) const {
  if (!exact_[n]) exact_[n] = make_exact(nodes_[n]);
  return *exact_[n];
}

LocalNodes::PairFraction LocalNodes::pair_fraction(const LocalNode& node) const {
  const PairEnds& ends = pair_ends(node.a);
  const PairPoint d = ends[1] - ends[0];
  if (node.kind == LocalNode::Kind::wall) {
    const LocalWall& wall = walls_.all()[node.b];
    const base::DoublePair from = wall.axis == 0 ? ends[0].x : ends[0].y;
    return {wall.pair - from, wall.axis == 0 ? d.x : d.y, 4 * kPairGap};
  }
  const PairEnds& others = pair_ends(node.b);
  const PairPoint e = others[1] - others[0], gap = others[0] - ends[0];
  return {planar::cross(gap, e), planar::cross(d, e), 2 * std::max(pair_cross_off(gap, e), pair_cross_off(d, e))};
}

// Ends are off by 2 kPairOff, as sums. A share n / w of at most 1 is off by what n and w are, over w, and by roundings.
LocalNodes::PairPosition LocalNodes::make_pair_position(const LocalNode& node) const {
  const PairEnds& ends = pair_ends(node.a);
  if (node.kind == LocalNode::Kind::end) return {ends[node.b], 2 * PosedRegions::kPairOff};
  const PairPoint d = ends[1] - ends[0];
  const auto [n, w, off] = pair_fraction(node);
  if (!(std::abs(w.high) > 4 * off)) return {ends[0], INFINITY};
  const base::DoublePair fraction = n / w;
  const double size = std::abs(d.x.high) + std::abs(d.y.high);
  return {{ends[0].x + d.x * fraction, ends[0].y + d.y * fraction}, 4 * off / std::abs(w.high) * size + 4 * kPairGap};
}

const LocalNodes::PairPosition& LocalNodes::pair_position(std::uint32_t n) const {
  std::optional<PairPosition>& kept = pair_positions_[n];
  if (!kept) kept = make_pair_position(nodes_[n]);
  return *kept;
}

/// The sign of m less n along an axis, 0 where pairs of doubles do not decide.
int LocalNodes::pair_order(std::uint32_t m, std::uint32_t n, int axis) const {
  const PairPosition &a = pair_position(m), &b = pair_position(n);
  const double gap = (axis == 0 ? a.at.x - b.at.x : a.at.y - b.at.y).value(), off = (a.off + b.off) * (1 + 0x1p-40);
  return gap > off ? 1 : gap < -off ? -1 : 0;
}

/// Each node by itself, but that ends which are sums of the same two vertices are one.
std::vector<std::uint32_t> LocalNodes::first_of_same_name() const {
  std::vector<std::uint32_t> same(nodes_.size());
  std::iota(same.begin(), same.end(), 0U);
  std::vector<std::array<std::uint32_t, 3>> names;  // of ends, which are the first nodes
  for (std::uint32_t n = 0; n < 2 * segments_.size(); ++n) {
    const Pair v = end_name(n / 2, n % 2);
    names.push_back({v.p, v.q, n});
  }
  std::sort(names.begin(), names.end());
  for (std::size_t k = 1; k < names.size(); ++k)
    if (names[k][0] == names[k - 1][0] && names[k][1] == names[k - 1][1]) same[names[k][2]] = same[names[k - 1][2]];
  return same;
}

// The position of a crossing or wall node is a + (n / w) d along its segment, so beside the line of u, which starts at
// c with direction e, it is (e x (a - c) + (n / w) (e x d)) / |e|. Of lines that are parallel but for a rounding all
// four numbers are small and known to many digits, where the place itself is not.
bool LocalNodes::provably_beside(const LocalNode& node, std::uint32_t u) const {
  if (node.a == u || (node.kind == LocalNode::Kind::crossing && node.b == u)) return false;
  const PairEnds &at = pair_ends(node.a), &line = pair_ends(u);
  const PairPoint d = at[1] - at[0], e = line[1] - line[0];
  if (node.kind == LocalNode::Kind::end) return proved_cross(e, at[node.b] - line[0]) != 0;
  const PairFraction fraction = pair_fraction(node);
  const PairPoint gap = at[0] - line[0];
  const double g = planar::cross(e, gap).value(), k = planar::cross(e, d).value(), n = fraction.n.value(),
               w = fraction.w.value();
  const double g_off = pair_cross_off(e, gap) + kTwice * std::abs(g),
               k_off = pair_cross_off(e, d) + kTwice * std::abs(k), n_off = fraction.off + kTwice * std::abs(n),
               w_off = fraction.off + kTwice * std::abs(w);
  const double off = std::abs(g) * w_off + g_off * (std::abs(w) + w_off) + std::abs(n) * k_off +
                     n_off * (std::abs(k) + k_off) + kTwice * (std::abs(g * w) + std::abs(n * k));
  return std::abs(g * w + n * k) > 2 * off;
}

/// Whether one is provably beside a line that the other one is on.
bool LocalNodes::provably_apart(std::uint32_t m, std::uint32_t n) const {
  const auto off_lines = [&](const LocalNode& node, const LocalNode& of) {
    return provably_beside(node, of.a) || (of.kind == LocalNode::Kind::crossing && provably_beside(node, of.b));
  };
  return off_lines(nodes_[m], nodes_[n]) || off_lines(nodes_[n], nodes_[m]);
}

/// Those that neither names nor doubles nor pairs of these distinguish are compared exactly; each takes the number of
/// the first that is the same. Nodes outside of the larger box only end pieces that do not matter.
class LocalNodes::Merging {
 public:
  explicit Merging(const LocalNodes& nodes) : nodes_(nodes), same_(nodes.first_of_same_name()) {
    const ScaledBox reach = nodes.walls_.reach();
    for (std::uint32_t n = 0; n < same_.size(); ++n) {
      const LocalNode& v = nodes.nodes_[n];
      const double off = v.off + kEndOff;
      if (same_[n] != n || v.x + off < reach.x0 || v.x - off > reach.x1 || v.y + off < reach.y0 || v.y - off > reach.y1)
        continue;
      widest_ = std::max(widest_, v.off);
      all_.push_back(n);
    }
  }
  std::vector<std::uint32_t> run() {
    std::sort(all_.begin(), all_.end(), [&](std::uint32_t m, std::uint32_t n) { return x(m) < x(n); });
    find_near_others();
    merge_fine();
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (near_[i] != 0 && !fine(all_[i])) merge_coarse(i);
    for (std::uint32_t& n : same_) n = first(n);
    return std::move(same_);
  }

 private:
  /// Positions in pairs of doubles that are off by at most this are put into an order by themselves.
  static constexpr double kFine = 0x1p-70;
  double x(std::uint32_t n) const { return nodes_.nodes_[n].x; }
  bool fine(std::uint32_t n) const { return nodes_.pair_position(n).off <= kFine; }
  std::uint32_t first(std::uint32_t n) const {
    while (same_[n] != n) n = same_[n];
    return n;
  }
  bool close(std::uint32_t m, std::uint32_t n) const {
    const LocalNode &a = nodes_.nodes_[m], &b = nodes_.nodes_[n];
    const double off = a.off + b.off;
    return std::abs(b.x - a.x) <= off && std::abs(b.y - a.y) <= off;
  }
  // Most have none that doubles do not distinguish from them.
  void find_near_others() {
    near_.assign(all_.size(), 0);
    for (std::size_t i = 0; i < all_.size(); ++i)
      for (std::size_t j = i + 1; j < all_.size() && x(all_[j]) <= x(all_[i]) + 2 * widest_; ++j)
        if ((near_[i] == 0 || near_[j] == 0) && close(all_[i], all_[j])) near_[i] = near_[j] = 1;
  }
  void merge_fine() {
    std::vector<std::uint32_t> order;
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (near_[i] != 0 && fine(all_[i])) order.push_back(all_[i]);
    const auto at = [&](std::uint32_t n) -> const PairPoint& { return nodes_.pair_position(n).at; };
    std::sort(order.begin(), order.end(), [&](std::uint32_t m, std::uint32_t n) {
      const base::DoublePair &a = at(m).x, &b = at(n).x;
      return a.high != b.high ? a.high < b.high : a.low < b.low;
    });
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        if ((at(order[j]).x - at(order[i]).x).value() > 4 * kFine) break;
        if (std::abs((at(order[j]).y - at(order[i]).y).value()) <= 4 * kFine) merge(order[i], order[j]);
      }
  }
  // Merges a node with all that doubles do not distinguish from it.
  void merge_coarse(std::size_t i) {
    const std::uint32_t n = all_[i];
    const auto query = [&](std::uint32_t m) {
      if (close(m, n)) merge(m, n);
    };
    for (std::size_t j = i + 1; j < all_.size() && x(all_[j]) <= x(n) + 2 * widest_; ++j) query(all_[j]);
    for (std::size_t j = i; j-- > 0 && x(all_[j]) >= x(n) - 2 * widest_;)
      if (fine(all_[j])) query(all_[j]);
  }
  void merge(std::uint32_t m, std::uint32_t n) {
    const std::uint32_t a = first(m), b = first(n);
    if (a == b || nodes_.pair_order(m, n, 0) != 0 || nodes_.pair_order(m, n, 1) != 0 || nodes_.provably_apart(m, n) ||
        !same_position(nodes_.exact(m), nodes_.exact(n)))
      return;
    same_[std::max(a, b)] = std::min(a, b);
  }

  const LocalNodes& nodes_;
  std::vector<std::uint32_t> same_, all_;  // by node; to be distinguished, by their doubles
  std::vector<std::uint8_t> near_;         // of all_: others are near
  double widest_ = 0;
};

void LocalNodes::merge_same() {
  const std::vector<std::uint32_t> same = Merging(*this).run();
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
      const bool on_it = node.kind == LocalNode::Kind::wall && node.b == k;
      node.in_box = on_it || compare(exact(n), wall.exact, wall.axis) * inward >= 0;
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
