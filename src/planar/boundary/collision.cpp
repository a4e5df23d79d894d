#include "planar/boundary/collision.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planar/operand/lattice.h"

namespace dymsum::planar {

Collision::Collision(const Lattice& lattice, const Operand& p, const Operand& q, bool use_tree)
    : lattice_(lattice),
      operands_{&p, &q},
      use_tree_(use_tree),
      beyond_doubles_(lattice.tier_bits == 0 ? exact::Rung::big : exact::Rung::integers) {}

bool Collision::overlaps(const SegmentPosition& x) {
  displaced_ = false;
  return test(x);
}

bool Collision::overlaps_right_of(const SegmentPosition& x) {
  displaced_ = true;
  return test(x);
}

// The coordinates are those of LatticeOf's positions.
Collision::Homogeneous Collision::homogeneous(const SegmentPosition& x) const {
  const Whole d = whole(x.on.edge);
  if (!x.between && x.first.kind == Cut::Kind::pair) {
    const Whole at = whole(x.first.pair);
    return {at.x, at.y, 1, d};
  }
  const Whole from = whole(start_of(x.on));
  struct Ratio {
    std::int64_t n, d;
  };
  const auto parameter = [&](const Cut& cut) {
    Ratio r;
    if (cut.kind == Cut::Kind::crossing) {
      const Whole b = whole(cut.by.edge), start = whole(start_of(cut.by));
      r = {b.x * (from.y - start.y) - b.y * (from.x - start.x), d.x * b.y - d.y * b.x};
    } else {
      const Whole at = whole(cut.pair);
      r = d.x != 0 ? Ratio{at.x - from.x, d.x} : Ratio{at.y - from.y, d.y};
    }
    return r.d < 0 ? Ratio{-r.n, -r.d} : r;
  };
  Ratio t = parameter(x.first);
  if (x.between) {
    const Ratio u = parameter(x.second);
    t = {t.n + u.n, t.d + u.d};
  }
  const exact::i128 n = t.n, w = t.d;
  return {from.x * w + d.x * n, from.y * w + d.y * n, t.d, d};
}

int Collision::cross(const Edge& d, const Edge& e) const {
  if (!integral_) return lattice_.cross(d, e);
  const Whole a = whole(d), b = whole(e);
  const std::int64_t left = a.x * b.y, right = a.y * b.x;
  return (left > right) - (left < right);
}

int Collision::dot(const Edge& d, const Edge& e) const {
  if (!integral_) return lattice_.dot(d, e);
  const Whole a = whole(d), b = whole(e);
  const std::int64_t value = a.x * b.x + a.y * b.y;
  return (value > 0) - (value < 0);
}

// The side of the line of (edge + vertex) on which x lies: of the edge, with Q reflected and moved to x.
int Collision::side(std::uint32_t op, std::uint32_t edge, std::uint32_t vertex) {
  const Operand &o = *operands_[op], &other = *operands_[1 - op];
  const double ex = o.ex[edge], ey = o.ey[edge];
  const double sx = o.x[edge] + other.x[vertex], sy = o.y[edge] + other.y[vertex];
  const double value = ex * (x_->y - sy) - ey * (x_->x - sx);
  const double bound = (std::abs(ex) + std::abs(ey)) * (x_->error + kSumSide * lattice_.span) + exact::kUnderflow;
  if (value > bound || value < -bound) {
    counts_.signs.count(exact::Rung::doubles);
    return value > 0 ? 1 : -1;
  }
  counts_.signs.count(beyond_doubles_);
  if (integral_) {
    const std::int64_t dx = integer(ex), dy = integer(ey);
    const exact::i128 x = at_.x - exact::i128{integer(sx)} * at_.w, y = at_.y - exact::i128{integer(sy)} * at_.w;
    const exact::i128 exact = dx * y - dy * x;
    if (exact != 0 || !displaced_) return (exact > 0) - (exact < 0);
    const std::int64_t dot = dx * at_.ahead.x + dy * at_.ahead.y;  // as below
    const std::int64_t first = dot != 0 ? -dot : dx * at_.ahead.y - dy * at_.ahead.x;
    return (first > 0) - (first < 0);
  }
  const Segment s{o.edge(edge), other.source[vertex]};
  const Segment& on = x_->on;
  // x lies on the segment that it is given on: no need to ask.
  const bool own =
      s.edge.op == on.edge.op && s.edge.from == on.edge.from && s.edge.to == on.edge.to && s.vertex == on.vertex;
  const int exact = own ? 0 : lattice_.side(s, *x_);
  if (exact != 0 || !displaced_) return exact;
  // d x (right normal of the carrier) = -(d . carrier); if that is zero too, d x carrier decides, as edges are not
  // zero.
  const int first = -lattice_.dot(s.edge, x_->on.edge);
  return first != 0 ? first : lattice_.cross(s.edge, x_->on.edge);
}

// The sign of d . (x - vertex - start), or of -d . (x - vertex - end): both positive strictly between the ends.
int Collision::along(std::uint32_t op, std::uint32_t edge, std::uint32_t vertex, bool from_end) {
  const Operand& o = *operands_[op];
  if (integral_) {
    const Operand& other = *operands_[1 - op];
    const std::uint32_t v = from_end ? o.next[edge] : edge;
    const exact::i128 x = at_.x - exact::i128{integer(o.x[v] + other.x[vertex])} * at_.w;
    const exact::i128 y = at_.y - exact::i128{integer(o.y[v] + other.y[vertex])} * at_.w;
    const exact::i128 ahead = integer(o.ex[edge]) * x + integer(o.ey[edge]) * y;
    return from_end ? (ahead < 0) - (ahead > 0) : (ahead > 0) - (ahead < 0);
  }
  Edge e = o.edge(edge);
  if (from_end) std::swap(e.from, e.to);
  return lattice_.along({e, operands_[1 - op]->source[vertex]}, *x_);
}

bool Collision::test(const SegmentPosition& x) {
  ++counts_.tests;
  x_ = &x;
  integral_ = lattice_.to_integers != 0;
  if (integral_) at_ = homogeneous(x);
  answered_by_.reset();
  // Positions are queried in spatial order, so what crossed at the last ones often crosses here.
  for (std::size_t k = 0; use_tree_ && k < witness_count_; ++k)
    if (edges_cross(witnesses_[k][0], witnesses_[k][1])) {
      ++counts_.witnessed;
      answered_by_ = witnesses_[k];
      return true;
    }
  for (std::uint32_t cp = 0; cp < operands_[0]->components.size(); ++cp)
    for (std::uint32_t cq = 0; cq < operands_[1]->components.size(); ++cq) {
      const int dp = operands_[0]->components[cp].dimension, dq = operands_[1]->components[cq].dimension;
      if (dp != 2 && dq != 2 && !with_parallelograms) continue;
      if (test_components(cp, cq)) return true;
    }
  return false;
}

bool Collision::test_components(std::uint32_t p_component, std::uint32_t q_component) {
  using Node = EdgeTree::Node;
  const EdgeTree &tp = operands_[0]->trees()[p_component], &tq = operands_[1]->trees()[q_component];
  const double margin = x_->error + kSumBox * lattice_.span;
  const Component &cp = operands_[0]->components[p_component], &cq = operands_[1]->components[q_component];
  const bool parallelogram = cp.dimension != 2 && cq.dimension != 2;
  const auto apart = [&](const Node& a, const Node& b) {
    return a.x1 < x_->x - b.x1 - margin || a.x0 > x_->x - b.x0 + margin || a.y1 < x_->y - b.y1 - margin ||
           a.y0 > x_->y - b.y0 + margin;
  };
  const auto leaves = [&](const Node& a, const Node& b) {
    for (std::uint32_t e = a.first; e < a.last; ++e) {
      // The box that an edge of Q has to reach, seen from e.
      const EdgeBox& box = operands_[0]->boxes[e];
      const double x0 = x_->x - std::max(box.ax, box.bx) - margin, x1 = x_->x - std::min(box.ax, box.bx) + margin;
      const double y0 = x_->y - std::max(box.ay, box.by) - margin, y1 = x_->y - std::min(box.ay, box.by) + margin;
      const auto reaches = [&](const EdgeBox& o) {
        return std::max(o.ax, o.bx) >= x0 && std::min(o.ax, o.bx) <= x1 && std::max(o.ay, o.by) >= y0 &&
               std::min(o.ay, o.by) <= y1;
      };
      if (use_tree_ && (b.x1 < x0 || b.x0 > x1 || b.y1 < y0 || b.y0 > y1)) continue;
      for (std::uint32_t f = b.first; f < b.last; ++f)
        if ((!use_tree_ || reaches(operands_[1]->boxes[f])) && edges_overlap(e, f, parallelogram)) return true;
    }
    return false;
  };
  if (!use_tree_) {
    const Node all_p{0, 0, 0, 0, cp.first, cp.last, 0, 0}, all_q{0, 0, 0, 0, cq.first, cq.last, 0, 0};
    if (leaves(all_p, all_q)) return true;
  } else if (any_pair_of_leaves(tp.nodes, 0, tq.nodes, 0, apart, leaves)) {
    return true;
  }
  if (parallelogram) return false;
  // No boundaries overlap: one component may hold the other, which then holds its first outer vertex.
  const Node &a = tp.nodes[0], &b = tq.nodes[0];
  if (apart(a, b)) return false;
  if (cp.dimension == 2 && contains_vertex(0, tp, cq.first)) return true;
  return cq.dimension == 2 && contains_vertex(1, tq, cp.first);
}

// Doubles only: the filter of side() for all four signs.
bool Collision::edges_cross(std::uint32_t e, std::uint32_t f) {
  const auto sides = [&](std::uint32_t op, std::uint32_t edge, std::uint32_t other_edge) {
    const Operand &o = *operands_[op], &other = *operands_[1 - op];
    const double ex = o.ex[edge], ey = o.ey[edge], ax = x_->x - o.x[edge], ay = x_->y - o.y[edge];
    const double bound = (std::abs(ex) + std::abs(ey)) * (x_->error + kSumSide * lattice_.span) + exact::kUnderflow;
    const auto value = [&](std::uint32_t v) { return ex * (ay - other.y[v]) - ey * (ax - other.x[v]); };
    const double s = value(other_edge), t = value(other.next[other_edge]);
    return (s > bound && t < -bound) || (s < -bound && t > bound);
  };
  return sides(0, e, f) && sides(1, f, e);
}

// Walk edges e of P and f of Q. Proper crossing, or a contact whose cones overlap.
bool Collision::edges_overlap(std::uint32_t e, std::uint32_t f, bool parallelogram) {
  ++counts_.edge_pairs;
  const Operand &p = *operands_[0], &q = *operands_[1];
  const bool edge_p = p.next[e] != e, edge_q = q.next[f] != f;  // a point has no edge
  if (!edge_p && !edge_q) return false;
  const std::uint32_t e1 = p.next[e], f1 = q.next[f];
  int s1 = 0, s2 = 0, s3 = 0, s4 = 0;
  if (edge_p) {
    s1 = side(0, e, f);
    s2 = edge_q ? side(0, e, f1) : s1;
    if (s1 * s2 > 0) return false;
  }
  if (edge_q) {
    s3 = side(1, f, e);
    s4 = edge_p ? side(1, f, e1) : s3;
    if (s3 * s4 > 0) return false;
  }
  if (edge_p && edge_q && s1 != 0 && s2 != 0 && s3 != 0 && s4 != 0) {
    witnesses_[next_witness_] = {e, f};
    answered_by_ = {e, f};
    next_witness_ = (next_witness_ + 1) % witnesses_.size();
    witness_count_ = std::min(witness_count_ + 1, witnesses_.size());
    return true;
  }
  if (parallelogram) return false;
  // Contacts of the walk vertices that start the two edges; the others come with their own edges.
  if (edge_p && s1 == 0) {
    const int from = along(0, e, f, false), to = along(0, e, f, true);
    if (from > 0 && to > 0 && cones_overlap(e, true, f, false)) return true;
    if (from == 0 && cones_overlap(e, false, f, false)) return true;
  }
  if (edge_q && s3 == 0) {
    const int from = along(1, f, e, false), to = along(1, f, e, true);
    if (from > 0 && to > 0 && cones_overlap(e, false, f, true)) return true;
  }
  return false;
}

// The open cone of P at walk vertex i (or along walk edge i) against that of the reflected Q at j.
struct Collision::Cone {
  // The sector from ray a counter-clockwise to ray b, each an edge times a sign; area: the open sector, otherwise just
  // the two rays.
  Edge a, b;
  int sign_a, sign_b;
  bool area;
};

bool Collision::cones_overlap(std::uint32_t i, bool whole_edge_p, std::uint32_t j, bool whole_edge_q) {
  const auto cone = [&](std::uint32_t op, std::uint32_t k, bool whole_edge, int reflect) {
    const Operand& o = *operands_[op];
    Cone c;
    c.a = o.edge(k);
    c.sign_a = reflect;
    c.b = whole_edge ? c.a : o.edge(o.prev[k]);
    c.sign_b = -reflect;
    std::uint32_t component = 0;
    while (o.components[component].last <= k) ++component;
    c.area = o.components[component].dimension == 2;
    return c;
  };
  const Operand &p = *operands_[0], &q = *operands_[1];
  if (p.next[i] == i || q.next[j] == j) return false;  // a point touches
  const Cone a = cone(0, i, whole_edge_p, 1), b = cone(1, j, whole_edge_q, -1);
  // Position of direction d relative to the open or half-open sector [c.a, c.b): turn t(c.a, d) < t(c.a, c.b).
  const auto turn = [&](const Edge& from, int sf, const Edge& to, int st) {
    const int c = cross(from, to) * sf * st;
    if (c > 0) return 1;                         // in (0, pi)
    if (c < 0) return 3;                         // in (pi, 2 pi)
    return dot(from, to) * sf * st > 0 ? 0 : 2;  // 0 or pi
  };
  const auto inside = [&](const Cone& c, const Edge& d, int sd, bool closed_start) {
    const int to_d = turn(c.a, c.sign_a, d, sd);
    if (to_d == 0) return closed_start;
    int to_b = turn(c.a, c.sign_a, c.b, c.sign_b);
    if (to_b == 0) return true;  // a full turn
    if (to_d != to_b) return to_d < to_b;
    if (to_d == 2) return false;
    return cross(d, c.b) * sd * c.sign_b > 0;
  };
  if (a.area && b.area) return inside(a, b.a, b.sign_a, true) || inside(b, a.a, a.sign_a, true);
  if (a.area) return inside(a, b.a, b.sign_a, false) || inside(a, b.b, b.sign_b, false);
  if (b.area) return inside(b, a.a, a.sign_a, false) || inside(b, a.b, a.sign_b, false);
  return false;
}

// The sign of the height of holder vertex a over the other operand's vertex v, reflected and moved to x.
int Collision::height(std::uint32_t holder, std::uint32_t a, std::uint32_t v) {
  const Operand &o = *operands_[holder], &other = *operands_[1 - holder];
  const double value = o.y[a] + other.y[v] - x_->y;
  const double bound = x_->error + kSumHeight * lattice_.span;
  if (value > bound || value < -bound) return value > 0 ? 1 : -1;
  counts_.signs.count(beyond_doubles_);
  int exact = 0;
  if (integral_) {
    const exact::i128 y = exact::i128{integer(o.y[a] + other.y[v])} * at_.w;
    exact = (y > at_.y) - (y < at_.y);
  } else {
    const std::uint32_t own = o.source[a], its = other.source[v];
    exact = lattice_.compare_coordinate(holder == 0 ? Pair{own, its} : Pair{its, own}, *x_, 1);
  }
  if (exact != 0 || !displaced_) return exact;
  // x moves by (dy, -dx) first, then by (dx, dy); the vertex seen from it moves the other way.
  const Point d = lattice_.vector(x_->on.edge);
  return d.x != 0 ? (d.x > 0 ? 1 : -1) : (d.y > 0 ? -1 : 1);
}

// Whether a vertex of the other operand, moved to x, lies strictly inside a component of `holder`: winding number by a
// ray to +x, vertices at the ray's height counting as below it.
bool Collision::contains_vertex(std::uint32_t holder, const EdgeTree& tree, std::uint32_t vertex) {
  const Operand &o = *operands_[holder], &other = *operands_[1 - holder];
  const double vx = x_->x - other.x[vertex], vy = x_->y - other.y[vertex];
  const double margin = x_->error + kSumBox * lattice_.span;
  int winding = 0;
  std::array<std::uint32_t, 64> stack;
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const EdgeTree::Node& node = tree.nodes[stack[--top]];
    if (node.y1 < vy - margin || node.y0 > vy + margin || node.x1 < vx - margin) continue;
    if (node.left != 0) {
      stack[top++] = node.left;
      stack[top++] = node.right;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      const double ay = o.y[i], by = o.y[o.next[i]];
      if ((ay < vy - margin && by < vy - margin) || (ay > vy + margin && by > vy + margin)) continue;
      const int ha = height(holder, i, vertex), hb = height(holder, o.next[i], vertex);
      if (ha * hb > 0) continue;
      if (ha == 0 && hb == 0) {
        if (along(holder, i, vertex, false) >= 0 && along(holder, i, vertex, true) >= 0)
          return false;  // on the boundary
        continue;
      }
      const int s = side(holder, i, vertex);
      if (s == 0) return false;  // on the boundary
      if (ha <= 0 && hb > 0 && s > 0) ++winding;
      if (ha > 0 && hb <= 0 && s < 0) --winding;
    }
  }
  return winding > 0;
}

}  // namespace dymsum::planar
