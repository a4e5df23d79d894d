#include "planar/motion/turning_forms.h"

#include <algorithm>

#include "exact/grid.h"

namespace dymsum::planar {

using exact::Big;
using exact::BigInteger;
using exact::Polynomial;

namespace {

/// The error of a cross or scalar product of two edge vectors as given is this times their |.|_1: two of the factors,
/// the product, the sum.
constexpr double kFixedEdges = exact::rounding_bound(4, 32);

double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
Point minus(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }

// (1 + t^2) (a + b cos + g sin), with cos and sin negative in chart 1.
std::array<BigInteger, 3> quadratic(const BigInteger& a, const BigInteger& b, const BigInteger& g, int chart) {
  if (chart == 0) return {a + b, 2 * g, a - b};
  return {a - b, -2 * g, a + b};
}

Polynomial polynomial(const std::array<BigInteger, 3>& c) { return Polynomial({Big(c[0]), Big(c[1]), Big(c[2])}); }

}  // namespace

void TurningForms::add_point(std::uint32_t op, const PlacedPoints& from, std::size_t k) {
  const int grid = base_.lattice->grid_exponent;
  const Point& v = from.input[k];
  exact_[op].push_back({exact::grid_coordinate<Big>(v.x, from.offset.x, grid).value(),
                        exact::grid_coordinate<Big>(v.y, from.offset.y, grid).value()});
}

TurningForms::TurningForms(const OperandPair& base) : TurningForms(base, 0) {}

TurningForms::TurningForms(const OperandPair& base, std::uint32_t further)
    : base_(base), operands_{&base.operands[0], &base.operands[1]} {
  for (std::uint32_t op = 0; op < 2; ++op) {
    const Operand& o = *operands_[op];
    for (std::uint32_t i = 0; i < o.size(); ++i) {
      points_[op].push_back({o.x[i], o.y[i]});
      add_point(op, *o.points, o.source[i]);
    }
    const PlacedPoints& all = *o.points;
    for (std::size_t k = all.input.size() - further; k < all.input.size(); ++k) {
      points_[op].push_back({all.x[k], all.y[k]});
      add_point(op, all, k);
    }
  }
  Point low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  for (const Point& p : points_[1]) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  centre_ = {(low.x + high.x) / 2, (low.y + high.y) / 2};
  for (Point& p : points_[1]) {
    p = minus(p, centre_);
    radius_.push_back(std::hypot(p.x, p.y));
    reach_ = std::max(reach_, radius_.back());
  }
  for (const Point& q : points_[0]) {
    width_ = std::max(width_, q.x);
    height_ = std::max(height_, q.y);
  }
  span_ = std::max(width_, height_) + 2 * reach_;
}

TurningForms::Vec TurningForms::vector(std::uint32_t op, std::uint32_t e) const {
  const Vec &a = exact_[op][e], &b = exact_[op][operands_[op]->next[e]];
  return {b.x - a.x, b.y - a.y};
}

TrigForm TurningForms::side(const WalkSegment& s, Pair v) const {
  const Pair from = start(s);
  const Point d = edge(s.side, s.edge), dq = minus(points_[0][v.p], points_[0][from.p]),
              dp = minus(points_[1][v.q], points_[1][from.q]);
  if (s.side == 0) return {planar::cross(d, dq), planar::cross(d, dp), dot(d, dp)};
  return {planar::cross(d, dp), planar::cross(d, dq), -dot(d, dq)};
}

TrigForm TurningForms::cross(const WalkSegment& s, const WalkSegment& t) const {
  const Point d = edge(s.side, s.edge), e = edge(t.side, t.edge);
  if (s.side == t.side) return {planar::cross(d, e), 0, 0};
  if (s.side == 1) return {0, planar::cross(d, e), -dot(d, e)};
  return {0, planar::cross(d, e), dot(d, e)};
}

bool TurningForms::parallel(const WalkSegment& s, const WalkSegment& t) const {
  if (s.side != t.side) return false;
  if (s.edge == t.edge) return true;
  const double value = planar::cross(edge(s.side, s.edge), edge(t.side, t.edge));
  if (std::abs(value) > kFixedEdges * length1(s) * length1(t)) return false;
  return base_.lattice->cross(operands_[s.side]->edge(s.edge), operands_[t.side]->edge(t.edge)) == 0;
}

// With the origin at the start of a, its own offset vanishes: h_b (d_c x d_a) + h_c (d_a x d_b), and h_k = d_k x
// (start_k - start_a) = -side(k, start_a).
TrigForm2 TurningForms::concurrency(const WalkSegment& a, const WalkSegment& b, const WalkSegment& c) const {
  TrigForm2 sum;
  sum.add_product(-side(b, start(a)), cross(c, a));
  sum.add_product(-side(c, start(a)), cross(a, b));
  return sum;
}

Polynomial TurningForms::exact_side(const WalkSegment& s, Pair v, int chart) const {
  const Form f = crossed(vector(s.side, s.edge), s.side, start(s), v);
  return polynomial(quadratic(f.a, f.b, f.g, chart));
}

// d turned with operand `side`, times v - u.
TurningForms::Form TurningForms::crossed(const Vec& d, std::uint32_t side, Pair u, Pair v) const {
  const Vec &q1 = exact_[0][v.p], &q0 = exact_[0][u.p], &p1 = exact_[1][v.q], &p0 = exact_[1][u.q];
  const Vec dq{q1.x - q0.x, q1.y - q0.y}, dp{p1.x - p0.x, p1.y - p0.y};
  const auto x = [&](const Vec& w) { return BigInteger(d.x * w.y - d.y * w.x); };
  const auto dot = [&](const Vec& w) { return BigInteger(d.x * w.x + d.y * w.y); };
  if (side == 0) return {x(dq), x(dp), dot(dp)};
  return {x(dp), x(dq), BigInteger(-dot(dq))};
}

TurningForms::Form TurningForms::cross_form(const WalkSegment& s, const WalkSegment& t) const {
  const Vec d = vector(s.side, s.edge), e = vector(t.side, t.edge);
  const BigInteger x = d.x * e.y - d.y * e.x, dot = d.x * e.x + d.y * e.y;
  if (s.side == t.side) return {x, 0, 0};
  return {0, x, s.side == 1 ? BigInteger(-dot) : dot};
}

// The polynomial of concurrency().
Polynomial TurningForms::exact_concurrency(const WalkSegment& a, const WalkSegment& b, const WalkSegment& c,
                                           int chart) const {
  const bool same = a.side == b.side && b.side == c.side;
  std::vector<Big> sum(same ? 3 : 5);
  const auto add_product = [&](const WalkSegment& s, const Form& d) {
    const Form h = crossed(vector(s.side, s.edge), s.side, start(s), start(a));
    const std::array<BigInteger, 3> u = quadratic(h.a, h.b, h.g, chart);
    if (same) {
      // The crosses are constant: of degree two.
      for (std::size_t i = 0; i < 3; ++i) sum[i] = sum[i] - Big(BigInteger(u[i] * d.a));
      return;
    }
    const std::array<BigInteger, 3> v = quadratic(d.a, d.b, d.g, chart);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) sum[i + j] = sum[i + j] - Big(BigInteger(u[i] * v[j]));
  };
  add_product(b, cross_form(c, a));
  add_product(c, cross_form(a, b));
  return Polynomial(std::move(sum));
}

Polynomial TurningForms::exact_cross(const WalkSegment& s, const WalkSegment& t, int chart) const {
  const Form f = cross_form(s, t);
  return polynomial(quadratic(f.a, f.b, f.g, chart));
}

// Let d' be d turned right; d . w = d' x w.
Polynomial TurningForms::exact_along(const WalkSegment& s, Pair u, Pair v, int chart) const {
  const Vec e = vector(s.side, s.edge);
  const Form f = crossed({BigInteger(e.y), BigInteger(-e.x)}, s.side, u, v);
  return polynomial(quadratic(f.a, f.b, f.g, chart));
}

Polynomial TurningForms::exact_alignment(std::uint32_t e, std::uint32_t f, int chart) const {
  const Vec d = vector(1, e), g = vector(0, f);
  return polynomial(quadratic(0, BigInteger(d.x * g.y - d.y * g.x), BigInteger(-(d.x * g.x + d.y * g.y)), chart));
}

int TurningForms::alignment_chart(std::uint32_t e, std::uint32_t f) const {
  const Point d = edge(1, e), g = edge(0, f);
  const double scale = kFixedEdges * (std::abs(d.x) + std::abs(d.y)) * (std::abs(g.x) + std::abs(g.y));
  if (const double v = dot(d, g); std::abs(v) > scale) return v > 0 ? 0 : 1;
  const Vec u = vector(1, e), v = vector(0, f);
  const int along = BigInteger(u.x * v.x + u.y * v.y).sign();
  if (along != 0) return along > 0 ? 0 : 1;
  return BigInteger(u.x * v.y - u.y * v.x).sign() > 0 ? 0 : 1;
}

RotationCatalog::RotationCatalog(const TurningForms& forms) : forms_(forms) {
  for (std::uint32_t op = 0; op < 2; ++op) {
    const Operand& o = forms.operand(op);
    angle_[op].resize(o.size());
    turn_[op].resize(o.size());
    of_hole_[op].resize(o.size());
    for (const Loop& loop : o.loops)
      for (std::uint32_t i = loop.first; i < loop.last; ++i) {
        if (forms.is_point(op, i)) continue;  // it has no edge
        angle_[op][i] = positive_angle(std::atan2(o.ey[i], o.ex[i]));
        of_hole_[op][i] = loop.kind == LoopKind::hole;
        edges_[op].push_back({angle_[op][i], i});
        if (loop.kind != LoopKind::hole) outer_edges_[op].push_back({angle_[op][i], i});
      }
    for (auto* list : {&edges_[op], &outer_edges_[op]})
      std::sort(list->begin(), list->end(),
                [](const Edge& a, const Edge& b) { return a.angle != b.angle ? a.angle < b.angle : a.edge < b.edge; });
    start_[op].index(edges_[op]);
    outer_start_[op].index(outer_edges_[op]);
    const auto ranks = [&](const std::vector<Edge>& list, std::vector<std::uint32_t>& rank) {
      rank.assign(o.size(), ~std::uint32_t{0});
      for (std::uint32_t k = 0; k < list.size(); ++k) rank[list[k].edge] = k;
    };
    ranks(edges_[op], rank_[op]);
    ranks(outer_edges_[op], outer_rank_[op]);
    for (std::uint32_t i = 0; i < o.size(); ++i) {
      if (!o.convex[i]) continue;
      const double in = angle_[op][o.prev[i]];
      turn_[op][i] = forms.is_point(op, i) ? kTurn : positive_angle(angle_[op][i] - in);
      corners_[op].push_back({in, turn_[op][i], i, of_hole_[op][i] != 0});
    }
  }
}

void RotationCatalog::Starts::index(const std::vector<Edge>& edges) {
  first.assign(edges.size(), 0);
  std::uint32_t at = 0;
  for (std::size_t k = 0; k < first.size(); ++k) {
    while (at < edges.size() && interval(edges[at].angle) < k) ++at;
    first[k] = at;
  }
}

bool RotationCatalog::may_exist(const WalkSegment& s) const {
  return convex(1 - s.side, s.vertex) && !forms_.is_point(s.side, s.edge) &&
         !(of_hole_[s.side][s.edge] && of_hole_[1 - s.side][s.vertex]);
}

RotationCatalog::Existence RotationCatalog::exists(const WalkSegment& s, double theta) const {
  if (!may_exist(s)) return Existence::no;
  const std::uint32_t op = 1 - s.side;
  if (forms_.is_point(op, s.vertex)) return Existence::yes;
  const double in = angle_[op][forms_.operand(op).prev[s.vertex]];
  const double relative = s.side == 0 ? angle_[0][s.edge] - theta - in : angle_[1][s.edge] + theta - in;
  const double a = positive_angle(relative);
  if (a < kAngleSlack || a > kTurn - kAngleSlack || std::abs(a - turn_[op][s.vertex]) < kAngleSlack)
    return Existence::unsure;
  return a < turn_[op][s.vertex] ? Existence::yes : Existence::no;
}

RotationCatalog::Joint RotationCatalog::joint(Pair v, double theta) const {
  Joint joint;
  const std::array<std::uint32_t, 2> at{v.p, v.q};
  for (std::uint32_t side = 0; side < 2; ++side) {
    const WalkSegment in{side, forms_.operand(side).prev[at[side]], at[1 - side]}, out{side, at[side], at[1 - side]};
    if (const Existence e = exists(in, theta); e != Existence::no) {
      joint.unsure |= e == Existence::unsure || joint.has_in;
      joint.has_in = true;
      joint.in = in;
    }
    if (const Existence e = exists(out, theta); e != Existence::no) {
      joint.unsure |= e == Existence::unsure || joint.has_out;
      joint.has_out = true;
      joint.out = out;
    }
  }
  return joint;
}

}  // namespace dymsum::planar
