#include "cspace/family/turned_positions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "exact/big.h"
#include "exact/rounding_bound.h"
#include "planar/operand/sum_bounds.h"

namespace dymsum::planar {
namespace {

// In roundings of the reach: the cosine and the sine err by at most 8 (turn_of_orientation); the products, their sum
// and the last one. An edge vector has one more before it is turned.
constexpr int kOfTurn = 8, kOfPoint = kOfTurn + 4, kOfVector = kOfTurn + 4;
constexpr double kPointError = exact::rounding_bound(kOfPoint, 16), kVectorError = exact::rounding_bound(kOfVector, 16);
// A cross product of two edge vectors errs by what both err by, and three of its own; with a gap of two points, which
// errs absolutely, by one more.
constexpr double kCrossError = exact::rounding_bound(2 * kOfVector + 3 + 1, 32);
// Quotients and sums: a fraction, its product and the last sum.
constexpr double kFractionError = exact::rounding_bound(4, 8);

Point turned(Point v, Turn2 turn) { return {turn.cosine * v.x - turn.sine * v.y, turn.sine * v.x + turn.cosine * v.y}; }
Point sum(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
Point gap(Point a, Point b) { return {b.x - a.x, b.y - a.y}; }
double size_of(Point v) { return std::abs(v.x) + std::abs(v.y); }
double cross_of(Point a, Point b) { return a.x * b.y - a.y * b.x; }

double reach_of(const std::vector<Point>& points) {
  double reach = 0;
  for (const Point& v : points) reach = std::max(reach, size_of(v));
  return reach;
}

/// What a contact's edge ends at, by its index, and source vertices of all indices.
struct EdgeEndIndex {
  explicit EdgeEndIndex(const Operand& o) : end(o.edge_of_index.size(), SumVertex::kNone) {
    for (std::uint32_t e = 0; e < o.size(); ++e)
      if (o.next[e] != e) end[o.edge_index[e]] = o.vertex_index[o.next[e]];
  }
  std::vector<std::uint32_t> end;
};

}  // namespace

// The tangent t of half the angle, or of a right angle less that, is at most 1, and errs by one rounding, or two where
// it is inverted: the cosine and the sine by less than 1.3 times that, so 2.6. Their own: t^2 and the numerator 2, the
// denominator 1.5, the quotient 1.
Turn2 turn_of_orientation(const Orientation& theta) {
  if (theta.is_half_turn()) return {-1, 0};
  const double tangent = theta.tan_half().to_double();
  const bool inverted = std::abs(tangent) > 1;
  const double t = inverted ? 1 / tangent : tangent, whole = 1 + t * t, cosine = (1 - t * t) / whole;
  return {inverted ? -cosine : cosine, 2 * t / whole};
}

TurnedPositions::TurnedPositions(const OperandPair& base, const CspaceObstacle& obstacle)
    : reach_(reach_of(base.lattice->points[0]->input) + reach_of(base.lattice->points[1]->input)) {
  const std::array<EdgeEndIndex, 2> ends{EdgeEndIndex(base.operands[0]), EdgeEndIndex(base.operands[1])};
  for (const Patch& patch : obstacle.patches()) {
    const Contact& c = patch.contact;
    const bool turns = c.kind == Contact::Kind::edge_of_q;
    const std::uint32_t op = turns ? 1 : 0, edge = turns ? c.q : c.p, vertex = turns ? c.p : c.q;
    const auto& own = base.lattice->points[op]->input;
    const auto& other = base.lattice->points[1 - op]->input;
    const auto [from, to] = base.operands[op].edge_of_index[edge];
    lines_.push_back(
        {own[from], own[to], other[base.operands[1 - op].vertex_of_index[vertex]], turns, patch.right_corner});
    const std::uint32_t end = ends[op].end[edge];
    corners_.push_back(!patch.right_corner ? Corner{} : turns ? Corner{vertex, end} : Corner{end, vertex});
  }
}

TurnedPositions::Placed TurnedPositions::corner(const Line& line, Turn2 turn) const {
  const Point at = line.turns ? sum(turned(line.to, turn), line.vertex) : sum(line.to, turned(line.vertex, turn));
  return {at, kPointError * reach_ + exact::kSubnormal};
}

// The fraction along `on` is n / d, n = (b - a) x e and d = d_on x e.
TurnedPositions::Placed TurnedPositions::crossing(const Line& on, const Line& other, Turn2 turn) const {
  const auto start = [&](const Line& l) {
    return l.turns ? sum(turned(l.from, turn), l.vertex) : sum(l.from, turned(l.vertex, turn));
  };
  const auto along = [&](const Line& l) {
    const Point v = gap(l.from, l.to);
    return l.turns ? turned(v, turn) : v;
  };
  const Point a = start(on), d = along(on), e = along(other), g = gap(a, start(other));
  const double n = cross_of(g, e), m = cross_of(d, e), fraction = n / m, point = kPointError * reach_;
  const double of_n = 2 * point * size_of(e) + kCrossError * size_of(g) * size_of(e) + exact::kSubnormal,
               of_m = kCrossError * size_of(d) * size_of(e) + exact::kSubnormal;
  if (!(4 * of_m < std::abs(m))) return {a, INFINITY};
  // Divided by less than three quarters of |m|, and rounded.
  const double of_fraction =
      1.5 * (of_n + std::abs(fraction) * of_m) / std::abs(m) + kFractionError * std::abs(fraction);
  const double error = point + size_of(d) * of_fraction + std::abs(fraction) * kVectorError * size_of(d) +
                       kFractionError * (reach_ + std::abs(fraction) * size_of(d)) + exact::kSubnormal;
  return {{a.x + fraction * d.x, a.y + fraction * d.y}, error <= kPoorPosition * reach_ ? error : INFINITY};
}

}  // namespace dymsum::planar
