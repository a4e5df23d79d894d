#include "fit/blocked_scales.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "exact/big.h"

namespace dymsum::planar {

using exact::BigRational;

std::vector<BlockedSearch::Edge> BlockedSearch::edges_of(const OperandPair& base, std::uint32_t op) {
  const Operand& o = base.operands[op];
  const auto& input = base.lattice->points[op]->input;
  std::vector<Edge> edges;
  for (std::uint32_t e = 0; e < o.size(); ++e) edges.push_back({input[o.source[e]], input[o.source[o.next[e]]]});
  return edges;
}

BlockedSearch::BlockedSearch(const OperandPair& base) : obstacles_(edges_of(base, 0)), part_(edges_of(base, 1)) {}

namespace {

/// a + b s for the four sides that decide whether edge e crosses edge z - s f: of the ends of e, then of those of f.
template <class Number>
struct EdgeSides {
  std::array<Number, 4> a, b;
};

/// As z - p = s q where the part's vertex q touches p: sides of the ends of e from the line of f, and of f from that of
/// e.
template <class Number, class Vector>
EdgeSides<Number> edge_sides(const std::array<Vector, 2>& e, const std::array<Vector, 2>& f, const Vector& z) {
  const auto cross = [](const Vector& d, const Vector& v) { return Number(d.x * v.y - d.y * v.x); };
  const auto minus = [](const Vector& u, const Vector& v) { return Vector{u.x - v.x, u.y - v.y}; };
  const Vector along_e = minus(e[1], e[0]), along_f = minus(f[1], f[0]);
  EdgeSides<Number> sides;
  for (std::size_t k = 0; k < 2; ++k) {
    sides.a[k] = cross(along_f, minus(e[k], z));
    sides.b[k] = cross(along_f, f[0]);
    sides.a[2 + k] = cross(along_e, minus(z, e[0]));
    sides.b[2 + k] = -cross(along_e, f[k]);
  }
  return sides;
}

template <class Number>
bool cross_at(const EdgeSides<Number>& sides, const Number& s) {
  std::array<Number, 4> v;
  for (std::size_t k = 0; k < 4; ++k) v[k] = sides.a[k] + sides.b[k] * s;
  return ((v[0] > 0 && v[1] < 0) || (v[0] < 0 && v[1] > 0)) && ((v[2] > 0 && v[3] < 0) || (v[2] < 0 && v[3] > 0));
}

/// Up to where they cross, roughly.
double crosses_until(const EdgeSides<double>& sides, double s) {
  double until = INFINITY;
  for (std::size_t k = 0; k < 4; ++k)
    if (const double root = -sides.a[k] / sides.b[k]; root > s) until = std::min(until, root);
  return until;
}

}  // namespace

std::optional<BlockedScales> BlockedSearch::about(const ExactSource::Position& z, const BigRational& s) const {
  const double near = exact::round_to_double(s);
  const Point at{exact::round_to_double(z.x), exact::round_to_double(z.y)};
  const Edge *best_e = nullptr, *best_f = nullptr;
  double best = 0;
  for (const Edge& f : part_) {
    const Point u{at.x - near * f.from.x, at.y - near * f.from.y}, v{at.x - near * f.to.x, at.y - near * f.to.y};
    const double x0 = std::min(u.x, v.x), x1 = std::max(u.x, v.x), y0 = std::min(u.y, v.y), y1 = std::max(u.y, v.y);
    for (const Edge& e : obstacles_) {
      if (std::max(e.from.x, e.to.x) < x0 || std::min(e.from.x, e.to.x) > x1 || std::max(e.from.y, e.to.y) < y0 ||
          std::min(e.from.y, e.to.y) > y1)
        continue;
      const EdgeSides<double> sides = edge_sides<double, Point>({e.from, e.to}, {f.from, f.to}, at);
      if (!cross_at(sides, near)) continue;
      if (const double until = crosses_until(sides, near); until > best) {
        best = until;
        best_e = &e;
        best_f = &f;
      }
    }
  }
  if (best_e == nullptr) return std::nullopt;
  using Position = ExactSource::Position;
  const auto exactly = [](Point p) { return Position{exact::exact_value(p.x), exact::exact_value(p.y)}; };
  const EdgeSides<BigRational> sides = edge_sides<BigRational, Position>(
      {exactly(best_e->from), exactly(best_e->to)}, {exactly(best_f->from), exactly(best_f->to)}, z);
  if (!cross_at(sides, s)) return std::nullopt;  // doubles were wrong
  BlockedScales blocked;
  for (std::size_t k = 0; k < 4; ++k) {
    if (sides.b[k] == 0) continue;
    const BigRational root = -sides.a[k] / sides.b[k];
    if (root < s) blocked.low = std::max(blocked.low, root);
    else if (!blocked.high || root < *blocked.high) blocked.high = root;
  }
  return blocked;
}

}  // namespace dymsum::planar
