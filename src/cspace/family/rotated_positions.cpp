#include "cspace/family/rotated_positions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "exact/big.h"
#include "exact/rounding_bound.h"
#include "planar/operand/lattice.h"

namespace dymsum::planar {
namespace {

// In roundings of the reach: the cosine and the sine err by at most 8 (rotor_of); the products, their sum
// and the last one. An edge vector has one more before it is rotated.
constexpr int kOfRotor = 8, kOfPoint = kOfRotor + 4, kOfVector = kOfRotor + 4;
constexpr double kPointError = exact::rounding_bound(kOfPoint, 16), kVectorError = exact::rounding_bound(kOfVector, 16);
// A cross product of two edge vectors errs by what both err by, and three of its own; with a gap of two points, which
// errs absolutely, by one more.
constexpr double kCrossError = exact::rounding_bound(2 * kOfVector + 3 + 1, 32);
// Quotients and sums: a fraction, its product and the last sum.
constexpr double kFractionError = exact::rounding_bound(4, 8);

Point rotated(Point v, Rotor rotor) {
  return {rotor.cosine * v.x - rotor.sine * v.y, rotor.sine * v.x + rotor.cosine * v.y};
}
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
Rotor rotor_of(const Orientation& theta) {
  if (theta.is_half_turn()) return {-1, 0};
  const double tangent = theta.tan_half().to_double();
  const bool inverted = std::abs(tangent) > 1;
  const double t = inverted ? 1 / tangent : tangent, whole = 1 + t * t, cosine = (1 - t * t) / whole;
  return {inverted ? -cosine : cosine, 2 * t / whole};
}

RotatedPositions::RotatedPositions(const OperandPair& base, const CspaceObstacle& obstacle)
    : reach_(reach_of(base.lattice->points[0]->input) + reach_of(base.lattice->points[1]->input)) {
  const std::array<EdgeEndIndex, 2> ends{EdgeEndIndex(base.operands[0]), EdgeEndIndex(base.operands[1])};
  for (const Patch& patch : obstacle.patches()) {
    const Contact& c = patch.contact;
    const bool moves = c.kind == Contact::Kind::edge_of_q;
    const std::uint32_t op = moves ? 1 : 0, edge = moves ? c.q : c.p, vertex = moves ? c.p : c.q;
    const auto& own = base.lattice->points[op]->input;
    const auto& other = base.lattice->points[1 - op]->input;
    const auto [from, to] = base.operands[op].edge_of_index[edge];
    lines_.push_back(
        {own[from], own[to], other[base.operands[1 - op].vertex_of_index[vertex]], moves, patch.right_corner});
    const std::uint32_t end = ends[op].end[edge];
    corners_.push_back(!patch.right_corner ? Corner{} : moves ? Corner{vertex, end} : Corner{end, vertex});
  }
}

RotatedPositions::Placed RotatedPositions::corner(const Line& line, Rotor rotor) const {
  const Point at = line.moves ? sum(rotated(line.to, rotor), line.vertex) : sum(line.to, rotated(line.vertex, rotor));
  return {at, kPointError * reach_ + exact::kSubnormal};
}

// The fraction along `on` is n / d, n = (b - a) x e and d = d_on x e.
RotatedPositions::Placed RotatedPositions::crossing(const Line& on, const Line& other, Rotor rotor) const {
  const auto start = [&](const Line& l) {
    return l.moves ? sum(rotated(l.from, rotor), l.vertex) : sum(l.from, rotated(l.vertex, rotor));
  };
  const auto along = [&](const Line& l) {
    const Point v = gap(l.from, l.to);
    return l.moves ? rotated(v, rotor) : v;
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
