#include "cspace/events/overlap_filter.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {

OverlapFilter::OverlapFilter(const TurningForms& forms, const EventWindow& window) : forms_(forms), window_(window) {
  for (std::uint32_t op = 0; op < 2; ++op) {
    Tree& tree = op == 0 ? fixed_ : turning_;
    for (const Component& c : forms.operand(op).components)
      tree.roots.push_back(
          build(tree, op, c.first, c.last, op == 0 ? 0 : forms.reach() * window.half * exact::kOutwards));
  }
}

std::uint32_t OverlapFilter::build(Tree& tree, std::uint32_t op, std::uint32_t first, std::uint32_t last,
                                   double grow) const {
  const auto id = static_cast<std::uint32_t>(tree.nodes.size());
  tree.nodes.push_back({});
  Node node{INFINITY, INFINITY, -INFINITY, -INFINITY, first, last, 0, 0};
  const std::vector<Point>& at = op == 0 ? forms_.points(0) : window_.turned;
  for (std::uint32_t i = first; i < last; ++i)
    for (const std::uint32_t v : {i, forms_.operand(op).next[i]}) {
      node.x0 = std::min(node.x0, at[v].x - grow);
      node.y0 = std::min(node.y0, at[v].y - grow);
      node.x1 = std::max(node.x1, at[v].x + grow);
      node.y1 = std::max(node.y1, at[v].y + grow);
    }
  if (last - first > 4) {
    const std::uint32_t midpoint = first + (last - first) / 2;
    node.left = build(tree, op, first, midpoint, grow);
    node.right = build(tree, op, midpoint, last, grow);
  }
  tree.nodes[id] = node;
  return id;
}

// A vertex of the rotating operand, reflected and moved to `at`.
Point OverlapFilter::placed(std::uint32_t v, Point at, Heading h) const {
  const Point p = forms_.points(1)[v];
  return {at.x - (h.c * p.x - h.s * p.y), at.y - (h.s * p.x + h.c * p.y)};
}

// Whether fixed edge i crosses the edge from c to d: the four sides, all beyond their errors.
bool OverlapFilter::cross(std::uint32_t i, Point c, Point d) const {
  const auto opposite = [&](Point u, Point v, Point x, Point y) {
    const double dx = v.x - u.x, dy = v.y - u.y, bound = kMargin * (std::abs(dx) + std::abs(dy)) * forms_.span();
    const double s = dx * (x.y - u.y) - dy * (x.x - u.x), t = dx * (y.y - u.y) - dy * (y.x - u.x);
    return (s > bound && t < -bound) || (s < -bound && t > bound);
  };
  const auto boxes_meet = [](double a, double b, double c, double d) {
    return std::min(a, b) <= std::max(c, d) && std::min(c, d) <= std::max(a, b);
  };
  const Point a = forms_.points(0)[i], b = forms_.points(0)[forms_.operand(0).next[i]];
  return boxes_meet(a.x, b.x, c.x, d.x) && boxes_meet(a.y, b.y, c.y, d.y) && opposite(a, b, c, d) &&
         opposite(c, d, a, b);
}

bool OverlapFilter::recent_cross(Point at, Heading h) const {
  for (std::size_t k = 0; k < known_; ++k) {
    const auto [i, j] = recent_[k];
    if (!cross(i, placed(j, at, h), placed(forms_.operand(1).next[j], at, h))) continue;
    std::rotate(recent_.begin(), recent_.begin() + static_cast<std::ptrdiff_t>(k),
                recent_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    return true;
  }
  return false;
}

// Whether a fixed edge of a leaf crosses a turning one.
bool OverlapFilter::edges_cross(const Node& fixed, const Node& turning, Point at, Heading h) const {
  for (std::uint32_t j = turning.first; j < turning.last; ++j) {
    const Point c = placed(j, at, h), d = placed(forms_.operand(1).next[j], at, h);
    for (std::uint32_t i = fixed.first; i < fixed.last; ++i) {
      if (!cross(i, c, d)) continue;
      known_ = std::min(known_ + 1, recent_.size());
      std::rotate(recent_.begin(), recent_.end() - 1, recent_.end());
      recent_[0] = {i, j};
      return true;
    }
  }
  return false;
}

// One of the four pairs of ends lies clearly on one side of the other edge's line.
bool OverlapFilter::edges_apart(std::uint32_t i, std::uint32_t j, Point at, Heading h) const {
  const Point a = forms_.points(0)[i], b = forms_.points(0)[forms_.operand(0).next[i]];
  const Point c = placed(j, at, h), d = placed(forms_.operand(1).next[j], at, h);
  const auto same_side = [&](Point u, Point v, Point x, Point y) {
    const double dx = v.x - u.x, dy = v.y - u.y, bound = kMargin * (std::abs(dx) + std::abs(dy)) * forms_.span();
    const double s = dx * (x.y - u.y) - dy * (x.x - u.x), t = dx * (y.y - u.y) - dy * (y.x - u.x);
    return (s > bound && t > bound) || (s < -bound && t < -bound);
  };
  const auto boxes_apart = [&](double a0, double a1, double b0, double b1) {
    const double margin = kMargin * forms_.span();
    return std::max(a0, a1) + margin < std::min(b0, b1) || std::max(b0, b1) + margin < std::min(a0, a1);
  };
  return same_side(a, b, c, d) || same_side(c, d, a, b) || boxes_apart(a.x, b.x, c.x, d.x) ||
         boxes_apart(a.y, b.y, c.y, d.y);
}

bool OverlapFilter::touches_only(Point at, Heading h, const std::vector<WalkSegment>& contacts) const {
  const Operand &p = forms_.operand(0), &q = forms_.operand(1);
  // An edge of one and an edge at the touching vertex of the other.
  const auto of_contact = [&](std::uint32_t i, std::uint32_t j) {
    for (const WalkSegment& s : contacts) {
      const std::uint32_t edge = s.side == 0 ? i : j, other = s.side == 0 ? j : i;
      const Operand& o = s.side == 0 ? q : p;
      if (edge == s.edge && (other == s.vertex || other == o.prev[s.vertex])) return true;
    }
    return false;
  };
  for (std::uint32_t i = 0; i < p.size(); ++i)
    for (std::uint32_t j = 0; j < q.size(); ++j)
      if (!edges_apart(i, j, at, h) && !of_contact(i, j)) return false;
  for (std::uint32_t cp = 0; cp < p.components.size(); ++cp)
    for (std::uint32_t cq = 0; cq < q.components.size(); ++cq) {
      const std::uint32_t v = q.components[cq].first, w = p.components[cp].first;
      const Point f = forms_.points(0)[w];
      if (holds(0, cp, placed(v, at, h), h) || holds(1, cq, {at.x - f.x, at.y - f.y}, h)) return false;
    }
  return true;
}

// Whether a component provably holds x in its interior; x relative to the component's own doubles.
bool OverlapFilter::holds(std::uint32_t op, std::uint32_t component, Point x, Heading h, double near) const {
  const Operand& o = forms_.operand(op);
  const Component& c = o.components[component];
  const auto at = [&](std::uint32_t v) {
    const Point p = forms_.points(op)[v];
    return op == 0 ? p : Point{h.c * p.x - h.s * p.y, h.s * p.x + h.c * p.y};
  };
  bool in = false;
  for (std::uint32_t i = c.first; i < c.last; ++i) {
    const Point a = at(i), b = at(o.next[i]);
    if (std::min(a.y, b.y) > x.y + near || std::max(a.y, b.y) < x.y - near || std::max(a.x, b.x) < x.x - near) continue;
    if (std::abs(a.y - x.y) <= near || std::abs(b.y - x.y) <= near) return false;
    const double cross = (b.x - a.x) * (x.y - a.y) - (b.y - a.y) * (x.x - a.x),
                 bound = near * (std::abs(b.x - a.x) + std::abs(b.y - a.y));
    if (std::abs(cross) <= bound) return false;
    in ^= (cross > 0) == (b.y > a.y);
  }
  return in;
}

bool OverlapFilter::inside(Point at, Heading h) const {
  if (recent_cross(at, h)) return true;
  const double margin = kMargin * forms_.span();
  const auto apart = [&](const Node& a, const Node& b) {
    return a.x1 < at.x - b.x1 - margin || a.x0 > at.x - b.x0 + margin || a.y1 < at.y - b.y1 - margin ||
           a.y0 > at.y - b.y0 + margin;
  };
  const auto leaves = [&](const Node& a, const Node& b) { return edges_cross(a, b, at, h); };
  for (std::uint32_t p = 0; p < fixed_.roots.size(); ++p)
    for (std::uint32_t q = 0; q < turning_.roots.size(); ++q) {
      if (any_pair_of_leaves(fixed_.nodes, fixed_.roots[p], turning_.nodes, turning_.roots[q], apart, leaves))
        return true;
      // No edges cross: one component may hold the other, and then its first vertex.
      const Component &cp = forms_.operand(0).components[p], &cq = forms_.operand(1).components[q];
      const Point f = forms_.points(0)[cp.first];
      if (holds(0, p, placed(cq.first, at, h), h)) return true;
      if (holds(1, q, {at.x - f.x, at.y - f.y}, h)) return true;
    }
  return false;
}

namespace {

/// Positions so near to each other, as a fraction of the span, get one answer.
constexpr double kCell = 0x1p-14;

}  // namespace

InnerPoints::InnerPoints(const TurningForms& forms, const OverlapFilter& filter) : forms_(forms), filter_(filter) {
  for (std::uint32_t op = 0; op < 2; ++op) {
    const Operand& o = forms.operand(op);
    for (std::uint32_t e = 0; e < forms.size(op); ++e) {
      const std::uint32_t component = o.component_of[e];
      if (o.components[component].dimension != 2) continue;
      const Point a = forms.points(op)[e], b = forms.points(op)[o.next[e]], d{b.x - a.x, b.y - a.y};
      for (const double fraction : {0.25, 0.0625, 0.015625}) {
        const Point x{(a.x + b.x) / 2 - fraction * d.y, (a.y + b.y) / 2 + fraction * d.x};
        if (!filter.holds(op, component, x, Heading{}, fraction / 2 * std::hypot(d.x, d.y))) continue;
        points_[op].push_back(x);
        break;
      }
    }
  }
}

bool InnerPoints::inside(std::uint32_t op, std::size_t k, Point at, Heading h, double margin) const {
  const Point p = points_[op][k];
  const Point x =
      op == 0 ? Point{at.x - p.x, at.y - p.y} : Point{at.x - (h.c * p.x - h.s * p.y), at.y - (h.s * p.x + h.c * p.y)};
  const std::size_t components = forms_.operand(1 - op).components.size();
  for (std::uint32_t c = 0; c < components; ++c)
    if (forms_.operand(1 - op).components[c].dimension == 2 && filter_.holds(1 - op, c, x, h, margin)) return true;
  return false;
}

bool InnerPoints::inside(Point at, Heading h, double margin) {
  const double cell = kCell * forms_.span(), x = std::nearbyint(at.x / cell), y = std::nearbyint(at.y / cell);
  const auto [it, fresh] = known_.try_emplace({static_cast<std::int64_t>(x), static_cast<std::int64_t>(y)}, false);
  if (fresh) it->second = find({x * cell, y * cell}, h, margin + cell);
  return it->second;
}

bool InnerPoints::find(Point at, Heading h, double margin) {
  for (const std::uint32_t op : {0U, 1U})
    if (last_[op] < points_[op].size() && inside(op, last_[op], at, h, margin)) return true;
  for (const std::uint32_t op : {1U, 0U})
    for (std::size_t k = 0; k < points_[op].size(); ++k)
      if (k != last_[op] && inside(op, k, at, h, margin)) {
        last_[op] = k;
        return true;
      }
  return false;
}

namespace {

/// Lengths in depths: how far from an edge nothing else may come, how near to an end a corner counts, and beyond one.
constexpr double kClear = 16, kCorner = 4, kBeyond = 2;
/// Twice as long, and corners apart.
constexpr double kLeastLength = 2 * kClear;

}  // namespace

EdgeAprons::Beside EdgeAprons::beside(std::uint32_t op, std::uint32_t edge, double along, double left) {
  std::uint8_t& known = clear_[op][edge];
  if (known == kUnknown) known = clear(op, edge) ? 1 : 0;
  if (known == 0 || !(std::abs(left) <= depth_)) return Beside::no;
  const Operand& o = forms_.operand(op);
  const Point d = forms_.edge(op, edge);
  const double length = std::hypot(d.x, d.y);
  if (!(along >= -kBeyond * depth_ && along <= length + kBeyond * depth_)) return Beside::no;
  // At a reflex corner the interior is what is left of one of the two edges, at a convex one what is left of both.
  if (along < kCorner * depth_ && o.convex[edge] != 0) return Beside::prev;
  if (along > length - kCorner * depth_ && o.convex[o.next[edge]] != 0) return Beside::next;
  return Beside::edge;
}

// A convex corner that is not sharp leaves the edge faster than at a quarter of its distance from the corner.
bool EdgeAprons::blunt(std::uint32_t op, std::uint32_t edge, std::uint32_t next) const {
  const Point d = forms_.edge(op, edge), e = forms_.edge(op, next);
  const double cross = d.x * e.y - d.y * e.x, dot = d.x * e.x + d.y * e.y;
  return dot >= 0 || std::abs(cross) >= 0.5 * std::hypot(d.x, d.y) * std::hypot(e.x, e.y);
}

// No other edge meets the rectangle around this one: it lies beyond one of its sides, or the rectangle beside its line.
bool EdgeAprons::clear(std::uint32_t op, std::uint32_t edge) const {
  const Operand& o = forms_.operand(op);
  if (o.components[o.component_of[edge]].dimension != 2 || forms_.is_point(op, edge)) return false;
  const std::uint32_t before = o.prev[edge], after = o.next[edge];
  if (!blunt(op, before, edge) || !blunt(op, edge, after)) return false;
  const std::vector<Point>& at = forms_.points(op);
  const Point a = at[edge], e = forms_.edge(op, edge);
  const double length = std::hypot(e.x, e.y), wide = kClear * depth_;
  if (!(length >= kLeastLength * depth_)) return false;
  const Point u{e.x / length, e.y / length};
  const auto seen = [&](Point p) {
    return Point{u.x * (p.x - a.x) + u.y * (p.y - a.y), u.x * (p.y - a.y) - u.y * (p.x - a.x)};
  };
  for (std::uint32_t f = 0; f < forms_.size(op); ++f) {
    if (f == edge || f == before || f == after) continue;
    const Point p = seen(at[f]), q = seen(at[o.next[f]]);
    if (std::max(p.x, q.x) < -wide || std::min(p.x, q.x) > length + wide || std::max(p.y, q.y) < -wide ||
        std::min(p.y, q.y) > wide)
      continue;
    const auto side = [&](double x, double y) { return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x); };
    const auto [least, most] =
        std::minmax({side(-wide, -wide), side(length + wide, -wide), side(length + wide, wide), side(-wide, wide)});
    const double margin = 0.01 * wide * std::hypot(q.x - p.x, q.y - p.y);
    if (!(least > margin || most < -margin)) return false;
  }
  return true;
}

}  // namespace dymsum::planar
