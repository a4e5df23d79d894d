#include "planar/frame/local_overlap.h"

#include <algorithm>
#include <cmath>

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

}  // namespace dymsum::planar
