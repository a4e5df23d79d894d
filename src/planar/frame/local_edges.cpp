#include "planar/frame/local_edges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/scratch.h"

namespace dymsum::planar {

/// Edge e of P and edge f of Q, reflected and moved to the position.
struct LocalOverlap::Edges {
  Point a0, a1, b0, b1;
};

/// A sector, from a counter-clockwise to b.
struct LocalOverlap::Cone {
  BigPoint a, b;
};

LocalOverlap::LocalOverlap(const Operand& p, const Operand& q)
    : operands_{&p, &q}, edges_{FeatureDiscs(p, FeatureDiscs::Of::edges), FeatureDiscs(q, FeatureDiscs::Of::edges)} {}

bool LocalOverlap::holds(const PosedRegions& posed, const QueriedPosition& position) {
  posed_ = &posed, position_ = &position;
  exact_.reset();
  off_ = position.off + 4 * PosedRegions::kOff;
  ++tests_;
  const bool overlapping = crossed_before() || boundaries_overlap() || holds_component(0) || holds_component(1);
  exact_tests_ += exact_.has_value();
  return overlapping;
}

bool LocalOverlap::crossed_before() {
  return witnesses_.find([&](const CrossingEdges& pair) { return provably_cross(edges(pair[0], pair[1])); })
      .has_value();
}

bool LocalOverlap::boundaries_overlap() {
  if (edges_[0].empty() || edges_[1].empty()) return false;
  std::vector<std::array<std::uint32_t, 2>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    const FeatureDiscs::Node &a = edges_[0].node(i), &b = edges_[1].node(j);
    const Point m = posed_->posed(0, a.centre), n = posed_->posed(1, b.centre);
    const double reach = posed_->stretched(0, a.radius) + posed_->stretched(1, b.radius) + 2 * off_;
    const double dx = m.x + n.x - position_->x, dy = m.y + n.y - position_->y;
    if (dx * dx + dy * dy > reach * reach * (1 + 0x1p-40)) continue;
    if (a.leaf() && b.leaf()) {
      for (std::uint32_t k = a.first; k < a.last; ++k)
        for (std::uint32_t l = b.first; l < b.last; ++l)
          if (edges_overlap(edges_[0].item(k), edges_[1].item(l))) return true;
    } else if (b.leaf() || (!a.leaf() && a.last - a.first >= b.last - b.first)) {
      stack.push_back({a.right, j}), stack.push_back({a.left, j});
    } else {
      stack.push_back({i, b.right}), stack.push_back({i, b.left});
    }
  }
  return false;
}

LocalOverlap::Edges LocalOverlap::edges(std::uint32_t e, std::uint32_t f) const {
  const Operand &p = *operands_[0], &q = *operands_[1];
  const Point at{position_->x, position_->y};
  return {posed_->vertex(0, e), posed_->vertex(0, p.next[e]), less(at, posed_->vertex(1, f)),
          less(at, posed_->vertex(1, q.next[f]))};
}

bool LocalOverlap::provably_cross(const Edges& s) const {
  const Point d = less(s.a1, s.a0), e = less(s.b1, s.b0);
  const int one = proved_cross(d, less(s.b0, s.a0), 2 * off_), two = proved_cross(e, less(s.a0, s.b0), 2 * off_);
  return one != 0 && two != 0 && proved_cross(d, less(s.b1, s.a0), 2 * off_) == -one &&
         proved_cross(e, less(s.a1, s.b0), 2 * off_) == -two;
}

const BigPosition& LocalOverlap::exact_position() {
  if (!exact_) exact_ = position_->exact();
  return *exact_;
}

BigPoint LocalOverlap::from_position(std::uint32_t p, std::uint32_t q) {
  const BigPosition& z = exact_position();
  const BigPoint v = posed_->exact(0, p) + posed_->exact(1, q);
  return {v.x * z.w - z.x, v.y * z.w - z.y};
}

/// The side of edge e of P on which the vertex of Q lies: 1 is its left.
int LocalOverlap::side_of_p_edge(std::uint32_t e, std::uint32_t q_vertex, const Edges& s, bool end) {
  const Point d = less(s.a1, s.a0);
  if (const int proved = proved_cross(d, less(end ? s.b1 : s.b0, s.a0), 2 * off_)) return proved;
  const BigPoint gap = from_position(e, q_vertex);  // the edge's start, seen from the vertex
  return -sign(cross(posed_->exact(0, operands_[0]->next[e]) - posed_->exact(0, e), gap));
}

int LocalOverlap::side_of_q_edge(std::uint32_t f, std::uint32_t p_vertex, const Edges& s, bool end) {
  const Point d = less(s.b1, s.b0);
  if (const int proved = proved_cross(d, less(end ? s.a1 : s.a0, s.b0), 2 * off_)) return proved;
  const BigPoint gap = from_position(p_vertex, f);  // the vertex, seen from the start of the reflected edge
  return sign(cross(posed_->exact(1, f) - posed_->exact(1, operands_[1]->next[f]), gap));
}

/// They cross properly, or what touches overlaps there.
bool LocalOverlap::edges_overlap(std::uint32_t e, std::uint32_t f) {
  const Operand &p = *operands_[0], &q = *operands_[1];
  const Edges s = edges(e, f);
  const auto apart = [&](double a, double b, double c, double d) {
    return std::max(a, b) < std::min(c, d) - 2 * off_ || std::min(a, b) > std::max(c, d) + 2 * off_;
  };
  if (apart(s.a0.x, s.a1.x, s.b0.x, s.b1.x) || apart(s.a0.y, s.a1.y, s.b0.y, s.b1.y)) return false;
  const int s1 = side_of_p_edge(e, f, s, false), s2 = side_of_p_edge(e, q.next[f], s, true);
  if (s1 * s2 > 0) return false;
  const int s3 = side_of_q_edge(f, e, s, false), s4 = side_of_q_edge(f, p.next[e], s, true);
  if (s3 * s4 > 0) return false;
  if (s1 != 0 && s2 != 0 && s3 != 0 && s4 != 0) {
    witnesses_.remember({e, f});
    return true;
  }
  return touch_overlapping(e, f, s1, s3);
}

/// Contacts of the vertices that start the two edges; others come with their own edges. `on_p`: 0 where Q's vertex lies
/// on the line of e; `on_q` likewise.
bool LocalOverlap::touch_overlapping(std::uint32_t e, std::uint32_t f, int on_p, int on_q) {
  const auto overlap = [&](bool p_edge, bool q_edge) {
    const Cone a = cone(0, e, p_edge), b = cone(1, f, q_edge);
    const auto turn = [](const BigPoint& from, const BigPoint& to) {
      const int c = sign(cross(from, to));
      return c > 0 ? 1 : c < 0 ? 3 : sign(dot(from, to)) > 0 ? 0 : 2;
    };
    const auto inside = [&](const Cone& c, const BigPoint& d) {
      const int to_d = turn(c.a, d), to_b = turn(c.a, c.b);
      if (to_d == 0) return true;
      if (to_d != to_b) return to_d < to_b;
      return to_d != 2 && sign(cross(d, c.b)) > 0;
    };
    return inside(a, b.a) || inside(b, a.a);
  };
  const BigPoint gap = from_position(e, f);  // the start of e, seen from that of f
  if (sign(gap.x) == 0 && sign(gap.y) == 0) return overlap(false, false);
  if (on_p == 0) {
    const BigPoint d = posed_->exact(0, operands_[0]->next[e]) - posed_->exact(0, e);
    if (sign(dot(d, gap)) < 0 && sign(dot(d, from_position(operands_[0]->next[e], f))) > 0 && overlap(true, false))
      return true;
  }
  if (on_q == 0) {
    const BigPoint d = posed_->exact(1, operands_[1]->next[f]) - posed_->exact(1, f);
    return sign(dot(d, gap)) < 0 && sign(dot(d, from_position(e, operands_[1]->next[f]))) > 0 && overlap(false, true);
  }
  return false;
}

/// The cone of an operand at a vertex, or along its edge: half a plane. Q's is reflected.
LocalOverlap::Cone LocalOverlap::cone(std::uint32_t op, std::uint32_t walk, bool along_edge) const {
  const Operand& o = *operands_[op];
  const BigPoint here = posed_->exact(op, walk), after = posed_->exact(op, o.next[walk]) - here;
  const BigPoint back = along_edge ? BigPoint{-after.x, -after.y} : posed_->exact(op, o.prev[walk]) - here;
  const auto turned = [&](const BigPoint& v) { return op == 0 ? v : BigPoint{-v.x, -v.y}; };
  return {turned(after), turned(back)};
}

/// Where no boundaries overlap a part of the other operand lies inside as a whole, or outside.
bool LocalOverlap::holds_component(std::uint32_t holder) {
  const Operand& other = *operands_[1 - holder];
  return !edges_[holder].empty() && std::any_of(other.components.begin(), other.components.end(),
                                                [&](const Component& c) { return contains(holder, c.first); });
}

/// The sign of a walk vertex's coordinate less that of the other operand's vertex, reflected and moved to the position.
int LocalOverlap::height(std::uint32_t holder, std::uint32_t walk, std::uint32_t vertex, int axis, Point seen) {
  const Point v = posed_->vertex(holder, walk);
  const double gap = axis == 0 ? v.x - seen.x : v.y - seen.y;
  if (std::abs(gap) > 2 * off_) return gap > 0 ? 1 : -1;
  const BigPoint exact = holder == 0 ? from_position(walk, vertex) : from_position(vertex, walk);
  return sign(axis == 0 ? exact.x : exact.y);
}

/// The winding number decides; a vertex on the boundary is not inside.
bool LocalOverlap::contains(std::uint32_t holder, std::uint32_t vertex) {
  const Operand& o = *operands_[holder];
  const Point v = posed_->vertex(1 - holder, vertex), seen{position_->x - v.x, position_->y - v.y};
  const auto provably_off = [&](const FeatureDiscs::Node& node) {
    const Point m = posed_->posed(holder, node.centre);
    const double reach = posed_->stretched(holder, node.radius) + 2 * off_;
    return std::abs(m.y - seen.y) > reach || m.x + reach < seen.x;
  };
  int winding = 0;
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const FeatureDiscs::Node& node = edges_[holder].node(stack.back());
    stack.pop_back();
    if (provably_off(node)) continue;
    if (!node.leaf()) {
      stack.push_back(node.left), stack.push_back(node.right);
      continue;
    }
    for (std::uint32_t k = node.first; k < node.last; ++k) {
      const std::uint32_t a = edges_[holder].item(k), b = o.next[a];
      const int ya = height(holder, a, vertex, 1, seen), yb = height(holder, b, vertex, 1, seen);
      if (ya == 0 || yb == 0) {
        const int xa = height(holder, a, vertex, 0, seen), xb = height(holder, b, vertex, 0, seen);
        if ((ya == 0 && xa == 0) || (ya == 0 && yb == 0 && xa * xb <= 0)) return false;
      }
      if ((ya <= 0) == (yb <= 0)) continue;
      const Point from = posed_->vertex(holder, a), d = less(posed_->vertex(holder, b), from);
      int side = proved_cross(d, less(seen, from), 2 * off_);
      if (side == 0) {
        const BigPoint gap = holder == 0 ? from_position(a, vertex) : from_position(vertex, a);
        side = -sign(cross(posed_->exact(holder, b) - posed_->exact(holder, a), gap));
      }
      if (side == 0) return false;
      if (ya <= 0 && side > 0) ++winding;
      if (yb <= 0 && side < 0) --winding;
    }
  }
  return winding != 0;
}

namespace {

/// A piece between two nodes, with the segments that run along it: from `low` to `high`, and back. One at least.
struct LocalPiece {
  std::uint32_t low = 0, high = 0;
  std::uint32_t ahead = kNone, back = kNone;
  bool both() const { return ahead != kNone && back != kNone; }
  std::uint32_t any() const { return ahead != kNone ? ahead : back; }
  bool forward() const { return ahead != kNone; }
};

/// A piece as it leaves a node.
struct Ray {
  std::uint32_t piece = 0;
  std::uint32_t segment = 0;
  bool with = false;             ///< the segment's direction leaves the node
  bool out = false, in = false;  ///< segments leave along it, arrive along it
};

/// A segment that does not end at a node: its rays there, as indices among the node's.
struct Passing {
  std::uint32_t after = 0, before = 0;
};

class LocalPatches {
 public:
  LocalPatches(const LocalNodes& nodes, LocalOverlap& overlap, Linking linking)
      : nodes_(nodes), overlap_(overlap), linking_(linking) {}

  LocalEdges run() {
    find_pieces();
    links_ = UnionFind(static_cast<std::uint32_t>(pieces_.size()));
    covered_.assign(pieces_.size(), 0);
    if (linking_ == Linking::patches)
      for (std::uint32_t n = 0; n < nodes_.node_count(); ++n)
        if (nodes_.node(n).known && !at_[n].empty()) look_around(n);
    spread();
    query_patches();
    return collect();
  }

 private:
  void find_pieces();
  void look_around(std::uint32_t n);
  std::vector<Ray> rays_at(std::uint32_t n) const;
  bool turns_before(const Ray& a, const Ray& b) const;
  int half(const Ray& r) const;
  void spread();
  void query_patches();
  bool inside_at(std::uint32_t n) const;
  bool inside_halfway(const LocalPiece& p) const;
  bool touches_box(const LocalPiece& p) const { return nodes_.node(p.low).in_box || nodes_.node(p.high).in_box; }
  bool may_be_tight(std::uint32_t n) const;
  LocalEdge rightwards(const LocalPiece& p) const;
  LocalEdges collect() const;

  const LocalNodes& nodes_;
  LocalOverlap& overlap_;
  Linking linking_;
  base::CountedArray<LocalPiece> pieces_;
  std::vector<std::vector<std::uint32_t>> at_;        // node -> pieces
  std::vector<std::vector<std::uint32_t>> segments_;  // node -> segments through it
  UnionFind links_;
  std::vector<std::uint8_t> covered_;
};

void LocalPatches::find_pieces() {
  std::map<std::pair<std::uint32_t, std::uint32_t>, LocalPiece> found;
  segments_.resize(nodes_.node_count()), at_.resize(nodes_.node_count());
  for (std::uint32_t s = 0; s < nodes_.segment_count(); ++s) {
    const std::vector<std::uint32_t>& along = nodes_.along(s);
    for (const std::uint32_t n : along) segments_[n].push_back(s);
    for (std::size_t k = 0; k + 1 < along.size(); ++k) {
      const std::uint32_t low = std::min(along[k], along[k + 1]), high = std::max(along[k], along[k + 1]);
      LocalPiece& piece = found[{low, high}];
      piece.low = low, piece.high = high;
      std::uint32_t& segment = along[k] == low ? piece.ahead : piece.back;
      segment = std::min(segment, s);
    }
  }
  for (const auto& [ends, piece] : found) {
    at_[piece.low].push_back(static_cast<std::uint32_t>(pieces_.size()));
    at_[piece.high].push_back(static_cast<std::uint32_t>(pieces_.size()));
    pieces_.push_back(piece);
  }
}

/// 0 for directions from 0 up to half a turn, 1 for the others.
int LocalPatches::half(const Ray& r) const {
  const int sign = r.with ? 1 : -1, y = sign * nodes_.direction(r.segment, 1);
  return y != 0 ? (y < 0 ? 1 : 0) : (sign * nodes_.direction(r.segment, 0) < 0 ? 1 : 0);
}

bool LocalPatches::turns_before(const Ray& a, const Ray& b) const {
  const int ha = half(a), hb = half(b);
  if (ha != hb) return ha < hb;
  return nodes_.cross(a.segment, b.segment) * (a.with == b.with ? 1 : -1) > 0;
}

/// Counter-clockwise.
std::vector<Ray> LocalPatches::rays_at(std::uint32_t n) const {
  std::vector<Ray> rays;
  for (const std::uint32_t k : at_[n]) {
    const LocalPiece& p = pieces_[k];
    const bool low = p.low == n;
    const bool ahead = p.ahead != kNone, back = p.back != kNone;
    rays.push_back({k, p.any(), p.forward() == low, low ? ahead : back, low ? back : ahead});
  }
  std::sort(rays.begin(), rays.end(), [&](const Ray& a, const Ray& b) { return turns_before(a, b); });
  return rays;
}

/// Sector k lies between ray k and the next one. On the left of a segment lies the sum. So a piece whose right side is
/// known to lie in the sum does too, unless segments of both directions run along it; and what bounds one sector with
/// its right sides bounds the sum where that sector lies outside: all of it, or nothing.
void LocalPatches::look_around(std::uint32_t n) {
  const std::vector<Ray> rays = rays_at(n);
  const std::size_t count = rays.size();
  std::vector<std::uint8_t> inside(count, 0);
  const auto before = [&](std::size_t k) { return (k + count - 1) % count; };
  for (std::size_t k = 0; k < count; ++k) {
    if (rays[k].out) inside[k] = 1;
    if (rays[k].in) inside[before(k)] = 1;
  }
  for (const std::uint32_t s : segments_[n]) {
    const std::vector<std::uint32_t>& along = nodes_.along(s);
    if (along.front() == n || along.back() == n) continue;
    const auto at = std::find(along.begin(), along.end(), n);
    const auto ray_to = [&](std::uint32_t m) {
      for (std::size_t k = 0; k < count; ++k)
        if (const LocalPiece& p = pieces_[rays[k].piece]; p.low == m || p.high == m) return k;
      return count;
    };
    const std::size_t first = ray_to(*(at + 1)), last = ray_to(*(at - 1));
    for (std::size_t k = first; k != last; k = (k + 1) % count) {
      inside[k] = 1;
      if (k != first) covered_[rays[k].piece] = 1;
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Ray& ray = rays[k];
    if (ray.out && ray.in) continue;
    if (inside[ray.out ? before(k) : k] != 0) covered_[ray.piece] = 1;
    else links_.unite(ray.piece, rays[ray.out ? before(k) : (k + 1) % count].piece);
  }
}

/// What is known of a piece holds for its patch.
void LocalPatches::spread() {
  std::vector<std::uint8_t> patch(pieces_.size(), 0);
  for (std::uint32_t k = 0; k < pieces_.size(); ++k)
    if (covered_[k] != 0) patch[links_.root(k)] = 1;
  for (std::uint32_t k = 0; k < pieces_.size(); ++k) covered_[k] = patch[links_.root(k)];
}

bool LocalPatches::inside_at(std::uint32_t n) const {
  const LocalNode& node = nodes_.node(n);
  return overlap_.holds(nodes_.posed(), {node.x, node.y, node.off, [&] { return nodes_.exact(n); }});
}

bool LocalPatches::inside_halfway(const LocalPiece& p) const {
  const LocalNode &a = nodes_.node(p.low), &b = nodes_.node(p.high);
  return overlap_.holds(nodes_.posed(), {(a.x + b.x) / 2, (a.y + b.y) / 2, std::max(a.off, b.off) + PosedRegions::kOff,
                                         [&] { return halfway(nodes_.exact(p.low), nodes_.exact(p.high)); }});
}

void LocalPatches::query_patches() {
  std::vector<std::uint32_t> queried(pieces_.size(), kNone);  // by patch: the piece that is queried
  const auto within = [&](const LocalPiece& p) { return nodes_.node(p.low).in_box && nodes_.node(p.high).in_box; };
  const auto order = [&](std::uint32_t k) { return within(pieces_[k]) ? 0 : touches_box(pieces_[k]) ? 1 : 2; };
  for (std::uint32_t k = 0; k < pieces_.size(); ++k) {
    std::uint32_t& best = queried[links_.root(k)];
    if (best == kNone || order(k) < order(best)) best = k;
  }
  for (std::uint32_t root = 0; root < pieces_.size(); ++root) {
    const std::uint32_t k = queried[root];
    if (k == kNone || covered_[k] != 0 || !touches_box(pieces_[k])) continue;
    covered_[root] = inside_halfway(pieces_[k]) ? 1 : 0;
  }
  for (std::uint32_t k = 0; k < pieces_.size(); ++k) covered_[k] = covered_[links_.root(k)];
}

/// Nothing there bounds the sum. Where one segment ends alone, where two meet and no more, or cross, the position is
/// covered with what is around it.
bool LocalPatches::may_be_tight(std::uint32_t n) const {
  if (!nodes_.node(n).in_box || at_[n].empty()) return false;
  if (std::any_of(at_[n].begin(), at_[n].end(), [&](std::uint32_t k) { return covered_[k] == 0; })) return false;
  if (linking_ == Linking::none) return true;
  if (at_[n].size() < 3) return false;
  const auto passes = [&](std::uint32_t s) { return nodes_.along(s).front() != n && nodes_.along(s).back() != n; };
  return segments_[n].size() != 2 || !passes(segments_[n][0]) || !passes(segments_[n][1]);
}

/// The one of both directions that leads to the right, or straight up.
LocalEdge LocalPatches::rightwards(const LocalPiece& p) const {
  const int x = nodes_.direction(p.ahead, 0);
  const bool ahead = x != 0 ? x > 0 : nodes_.direction(p.ahead, 1) > 0;
  return ahead ? LocalEdge{p.low, p.high, p.ahead} : LocalEdge{p.high, p.low, p.back};
}

LocalEdges LocalPatches::collect() const {
  LocalEdges edges;
  for (std::uint32_t k = 0; k < pieces_.size(); ++k) {
    const LocalPiece& p = pieces_[k];
    if (covered_[k] != 0 || !nodes_.node(p.low).in_box || !nodes_.node(p.high).in_box) continue;
    if (p.both()) edges.tight.push_back(rightwards(p));
    else edges.boundary.push_back(p.forward() ? LocalEdge{p.low, p.high, p.ahead} : LocalEdge{p.high, p.low, p.back});
  }
  for (std::uint32_t n = 0; n < nodes_.node_count(); ++n)
    if (may_be_tight(n) && !inside_at(n)) edges.tight_points.push_back(n);
  return edges;
}

}  // namespace

LocalEdges local_edges(const LocalNodes& nodes, LocalOverlap& overlap, Linking linking) {
  return LocalPatches(nodes, overlap, linking).run();
}

std::vector<LocalEdge> joined(const LocalNodes& nodes, std::vector<LocalEdge> edges) {
  const auto same_line = [&](const LocalEdge& a, const LocalEdge& b) {
    if (nodes.cross(a.segment, b.segment) != 0) return false;
    const int axis = nodes.direction(a.segment, 0) != 0 ? 0 : 1;
    return nodes.direction(a.segment, axis) == nodes.direction(b.segment, axis);
  };
  std::map<std::uint32_t, std::vector<std::size_t>> leaving;
  for (std::size_t k = 0; k < edges.size(); ++k) leaving[edges[k].from].push_back(k);
  std::vector<std::size_t> next(edges.size(), edges.size());
  std::vector<std::uint8_t> continues(edges.size(), 0);
  for (std::size_t k = 0; k < edges.size(); ++k)
    if (const auto list = leaving.find(edges[k].to); list != leaving.end())
      for (const std::size_t j : list->second)
        if (same_line(edges[k], edges[j])) next[k] = j, continues[j] = 1;
  std::vector<LocalEdge> result;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (continues[k] != 0) continue;
    LocalEdge edge = edges[k];
    for (std::size_t j = next[k]; j < edges.size(); j = next[j]) {
      edge.to = edges[j].to;
      edge.segment = std::min(edge.segment, edges[j].segment);
    }
    result.push_back(edge);
  }
  return result;
}

}  // namespace dymsum::planar
