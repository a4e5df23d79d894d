#include "planar/operand/fine_lattice.h"

#include <algorithm>
#include <cmath>

#include "exact/interval.h"
#include "planar/operand/make_lattice.h"

namespace dymsum::planar {
namespace {

/// The bits of factors and grids: far from where pairs of doubles over- or underflow.
constexpr int kMostBits = 900;

bool is_vertex(const SegmentPosition& x) { return !x.between && x.first.kind == Cut::Kind::pair; }

/// n / 2^top.
exact::FineInterval fraction(const exact::BigInteger& n, int top) {
  const base::DoublePair pair = exact::integer_pair(exact::Big(n));
  const double unit = power_of_two(-top), high = pair.high * unit, low = pair.low * unit,
               off = pair.high == 1 && pair.low == 0 ? 0 : std::abs(high) * exact::kIntegerPairError * exact::kOutwards;
  return exact::FineInterval(high) +
         exact::FineInterval(off == 0 ? exact::Interval(low) : exact::Interval(low) + exact::Interval(-off, off));
}

}  // namespace

FineLattice::FineLattice(const LatticeDoubles& doubles, const std::optional<LatticeScale>& scale)
    : points_{doubles.points[0].get(), doubles.points[1].get()} {
  // Factors of rotations may be negative.
  decides_ = points_[0]->turned == nullptr && points_[1]->turned == nullptr &&
             (!scale || (scale->x > 0 && scale->y > 0 && scale->den > 0));
  if (!decides_) return;
  const exact::BigInteger one = 1, &den = scale ? scale->den : one;
  int top = 0;
  if (scale) top = std::max({factor_bits(scale->x), factor_bits(scale->y), factor_bits(scale->den)});
  decides_ = top <= kMostBits && std::abs(doubles.grid_exponent - top) <= kMostBits;
  if (!decides_) return;
  for (std::uint32_t op = 0; op < 2; ++op) {
    const bool scaled = scale && op == scale->op;
    factor_[op] = {fraction(scaled ? scale->x : den, top), fraction(scaled ? scale->y : den, top)};
  }
  integer_ = Fine(power_of_two(doubles.grid_exponent - top));
}

FineLattice::Vec FineLattice::step(std::uint32_t op, std::uint32_t from, std::uint32_t to) const {
  if (from == to) return {};
  const Point &a = points_[op]->input[from], &b = points_[op]->input[to];
  return {Fine::difference(a.x, b.x) * factor_[op].x, Fine::difference(a.y, b.y) * factor_[op].y};
}
FineLattice::Vec FineLattice::step(Pair from, Pair to) const {
  const Vec p = step(0, from.p, to.p), q = step(1, from.q, to.q);
  return {p.x + q.x, p.y + q.y};
}

std::optional<int> FineLattice::cross(const Edge& d, const Edge& e) const {
  return decides_ ? sign_of(cross(edge(d), edge(e))) : std::nullopt;
}
std::optional<int> FineLattice::side(const Segment& s, Pair v) const {
  return decides_ ? sign_of(cross(edge(s.edge), step(start_of(s), v))) : std::nullopt;
}
std::optional<int> FineLattice::along(const Segment& s, Pair v) const {
  return decides_ ? sign_of(dot(edge(s.edge), step(start_of(s), v))) : std::nullopt;
}
std::optional<int> FineLattice::compare_coordinate(Pair a, Pair b, int axis) const {
  return decides_ ? sign_of(step(b, a).on(axis)) : std::nullopt;
}

// A cut at a pair has the same quotient along both axes; the longer one is known better.
FineLattice::Ratio FineLattice::parameter(const Segment& on, const Cut& cut, As as) const {
  const Vec d = edge(on.edge);
  Ratio r;
  if (cut.kind == Cut::Kind::crossing) {
    const Vec b = edge(cut.by.edge);
    r = {cross(b, step(start_of(cut.by), start_of(on))), cross(d, b)};
  } else {
    const std::vector<Point>& input = points_[on.edge.op]->input;
    const double x = std::abs(input[on.edge.to].x - input[on.edge.from].x),
                 y = std::abs(input[on.edge.to].y - input[on.edge.from].y);
    const int axis = as == As::integers ? (x != 0 ? 0 : 1) : (x >= y ? 0 : 1);
    r = {step(start_of(on), cut.pair).on(axis), d.on(axis)};
    if (as == As::integers) r = {r.n * integer_, r.d * integer_};
  }
  const std::optional<int> sign = sign_of(r.d);
  if (!sign || *sign == 0) return {Fine::whole(), Fine::whole()};
  return *sign > 0 ? r : Ratio{-r.n, -r.d};
}

FineLattice::Ratio FineLattice::ratio(const SegmentPosition& x) const {
  if (!x.between) return parameter(x.on, x.first, As::quotient);
  const Ratio a = parameter(x.on, x.first, As::integers), b = parameter(x.on, x.second, As::integers);
  return {a.n + b.n, a.d + b.d};
}

// The position is that of LatticeOf: start + d n / d.
std::optional<int> FineLattice::side(const Segment& s, const SegmentPosition& x) const {
  if (is_vertex(x)) return side(s, x.first.pair);
  if (!decides_) return std::nullopt;
  const Vec a = edge(s.edge);
  const Ratio t = ratio(x);
  return sign_of(t.d * cross(a, step(start_of(s), start_of(x.on))) + t.n * cross(a, edge(x.on.edge)));
}
std::optional<int> FineLattice::along(const Segment& s, const SegmentPosition& x) const {
  if (is_vertex(x)) return along(s, x.first.pair);
  if (!decides_) return std::nullopt;
  const Vec a = edge(s.edge);
  const Ratio t = ratio(x);
  return sign_of(t.d * dot(a, step(start_of(s), start_of(x.on))) + t.n * dot(a, edge(x.on.edge)));
}
std::optional<int> FineLattice::compare(const Segment& on, const Cut& a, const Cut& b) const {
  if (!decides_) return std::nullopt;
  const Ratio s = parameter(on, a, As::quotient), t = parameter(on, b, As::quotient);
  return sign_of(s.n * t.d - t.n * s.d);
}
std::optional<int> FineLattice::compare_coordinate(Pair a, const SegmentPosition& b, int axis) const {
  if (is_vertex(b)) return compare_coordinate(a, b.first.pair, axis);
  if (!decides_) return std::nullopt;
  const Ratio t = ratio(b);
  return sign_of(t.d * step(start_of(b.on), a).on(axis) - t.n * edge(b.on.edge).on(axis));
}
std::optional<int> FineLattice::compare_coordinate(const SegmentPosition& a, const SegmentPosition& b, int axis) const {
  if (!decides_) return std::nullopt;
  const Ratio s = ratio(a), t = ratio(b);
  return sign_of(step(start_of(b.on), start_of(a.on)).on(axis) * s.d * t.d + edge(a.on.edge).on(axis) * s.n * t.d -
                 edge(b.on.edge).on(axis) * t.n * s.d);
}

}  // namespace dymsum::planar
