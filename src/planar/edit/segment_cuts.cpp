#include "planar/edit/segment_cuts.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {

Cut cut_of(const Soup& soup, const SubEnd& end) {
  Cut cut;
  if (end.pair) {
    cut.pair = soup.exact(end.at);
  } else {
    cut.kind = Cut::Kind::crossing;
    cut.by = soup.exact(end.other);
  }
  return cut;
}

namespace {

// The parameter of a cut of s, where the soup's integers have 64 bits: 0 at its start, 1 at its end, and d > 0.
struct CutRatio {
  std::int64_t n, d;
};

CutRatio cut_ratio(const Soup& soup, std::uint32_t s, const SubEnd& end) {
  const SoupBox& b = soup.boxes[s];
  CutRatio r;
  if (end.pair) {
    const Operand &p = *soup.operands[0], &q = *soup.operands[1];
    if (b.dx != 0) r = {soup.integer(p.x[end.at.p] + q.x[end.at.q] - b.ax), soup.integer(b.dx)};
    else r = {soup.integer(p.y[end.at.p] + q.y[end.at.q] - b.ay), soup.integer(b.dy)};
  } else {
    r = {soup.side_value(end.other, b.ax, b.ay), soup.cross_value(s, end.other)};
  }
  return r.d < 0 ? CutRatio{-r.n, -r.d} : r;
}

// The denominators below err by these fractions of themselves: a component of a scaled vector; a cross product of two
// of them, times (|u| + |v|) / |u - v|, and the factor with its product.
constexpr double kLengthFraction = exact::rounding_bound(3, 8), kCrossFraction = exact::rounding_bound(8 + 2, 16);

// |denominator| of a cut's parameter as the lattice takes it, for the mediant.
double denominator(const Soup& soup, std::uint32_t s, const Cut& cut, double& relative_error) {
  const double dx = soup.dx(s), dy = soup.dy(s);
  if (cut.kind == Cut::Kind::pair) {
    const double length = dx != 0 ? std::abs(dx) : std::abs(dy);
    relative_error = length > exact::kUnderflow ? kLengthFraction : 1.0;
    return length;
  }
  const Point b = soup.lattice.vector(cut.by.edge);
  const double u = dx * b.y, v = dy * b.x, d = std::abs(u - v);
  relative_error = d > 0 ? std::min(1.0, (kCrossFraction * (std::abs(u) + std::abs(v)) + exact::kUnderflow) / d) : 1.0;
  // The denominator is in the integers of the exact layer, against which the other kind of cut is measured once less.
  return soup.lattice.in_integers(d);
}

}  // namespace

int compare_cuts(const Soup& soup, std::uint32_t s, const SubEnd& a, const SubEnd& b) {
  if (soup.integral()) {
    const CutRatio u = cut_ratio(soup, s, a), v = cut_ratio(soup, s, b);
    const exact::i128 left = exact::i128{u.n} * v.d, right = exact::i128{v.n} * u.d;
    return (left > right) - (left < right);
  }
  return soup.lattice.compare(soup.exact(s), cut_of(soup, a), cut_of(soup, b));
}

SegmentPosition position_of_cut(const Soup& soup, std::uint32_t s, const Cut& cut, double t, double t_error) {
  SegmentPosition p;
  p.on = soup.exact(s);
  p.first = cut;
  const SoupBox& b = soup.boxes[s];
  p.x = t == 1 ? b.bx : b.ax + t * b.dx;
  p.y = t == 1 ? b.by : b.ay + t * b.dy;
  p.error = t == 0 || t == 1 ? soup.point_error : soup.step_error(t_error, b.dx, b.dy);
  return p;
}

SegmentPosition sample_between(const Soup& soup, std::uint32_t s, const CutOnSegment& from, const CutOnSegment& to) {
  double error_from = 0, error_to = 0;
  const double d0 = denominator(soup, s, from.cut, error_from), d1 = denominator(soup, s, to.cut, error_to);
  double weight = d0 + d1 > 0 ? d1 / (d0 + d1) : 0.5;
  if (!(weight >= 0 && weight <= 1)) {
    weight = 0.5;
    error_from = 1;  // beyond the doubles: anywhere on the sub-edge
  }
  const double t = from.t + weight * (to.t - from.t);
  const double error = from.error + to.error + std::abs(to.t - from.t) * kMediantFractions * (error_from + error_to) +
                       kFractionRoundings;
  const bool at_end = t == 0 || t == 1;
  SegmentPosition p = position_of_cut(soup, s, from.cut, at_end ? 0.5 : t, error + (at_end ? 0.5 : 0));
  p.second = to.cut;
  p.between = true;
  return p;
}

}  // namespace dymsum::planar
