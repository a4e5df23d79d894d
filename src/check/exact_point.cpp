#include "check/exact_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dymsum::check {
namespace {

Interval around(double v) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {std::nextafter(v, -kInfinity), std::nextafter(v, kInfinity)};
}

/// p - q over the product of their weights, which is left out.
struct Difference {
  Difference(const HomogeneousPoint& p, const HomogeneousPoint& q)
      : x(p.x * q.w - q.x * p.w), y(p.y * q.w - q.y * p.w) {}
  BigInteger x, y;
};
BigInteger dot(const Difference& a, const Difference& b) { return a.x * b.x + a.y * b.y; }

/// Where along a segment the nearest position is.
enum class Foot { from, to, inside };

struct FootOf {
  FootOf(const HomogeneousPoint& p, const HomogeneousPoint& a, const HomogeneousPoint& b)
      : d(b, a), e(p, a), along(dot(d, e)), length(dot(d, d)) {
    // The parameter of the foot is along b.w / (length p.w).
    if (along <= 0 || length == 0) foot = Foot::from;
    else if (along * b.w >= length * p.w) foot = Foot::to;
  }
  Difference d, e;
  BigInteger along, length;
  Foot foot = Foot::inside;
};

Fraction squared_between(const HomogeneousPoint& p, const HomogeneousPoint& q) {
  const Difference d(p, q);
  const BigInteger w = p.w * q.w;
  return {dot(d, d), w * w};
}

}  // namespace

ExactPoint::ExactPoint(HomogeneousPoint p)
    : exact(exact::in_lowest_terms(std::move(p))),
      near{exact::round_to_double(exact.x, exact.w), exact::round_to_double(exact.y, exact.w)} {
  x = around(near.x);
  y = around(near.y);
}

Line line_through(const HomogeneousPoint& a, const HomogeneousPoint& b) {
  Line line{a.y * b.w - a.w * b.y, a.w * b.x - a.x * b.w, a.x * b.y - a.y * b.x};
  const BigInteger common = gcd(line.a, gcd(line.b, line.c));
  if (common > 1) line = {line.a / common, line.b / common, line.c / common};
  return line;
}

PointRef meeting_of(const Line& a, const Line& b) {
  HomogeneousPoint p{a.b * b.c - a.c * b.b, a.c * b.a - a.a * b.c, a.a * b.b - a.b * b.a};
  if (p.w < 0) p = {-p.x, -p.y, -p.w};
  return std::make_shared<const ExactPoint>(std::move(p));
}

Point seen_from(const HomogeneousPoint& q, const HomogeneousPoint& p) {
  const Difference d(p, q);
  const BigInteger w = p.w * q.w;
  return {exact::round_to_double(d.x, w), exact::round_to_double(d.y, w)};
}

int orientation(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  const Interval near = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (const std::optional<int> sign = sign_of(near)) return *sign;
  return line_through(a.exact, b.exact).at(c.exact).sign();
}

int compare_x(const ExactPoint& a, const ExactPoint& b) {
  if (a.near.x != b.near.x) return a.near.x < b.near.x ? -1 : 1;  // rounding to nearest is monotone
  return BigInteger(a.exact.x * b.exact.w).compare(BigInteger(b.exact.x * a.exact.w));
}

bool same_position(const ExactPoint& a, const ExactPoint& b) {
  return a.exact.x == b.exact.x && a.exact.y == b.exact.y && a.exact.w == b.exact.w;
}

Fraction squared_distance(const ExactPoint& p, const Segment& s) {
  const HomogeneousPoint &a = s.from->exact, &b = s.to->exact;
  const FootOf f(p.exact, a, b);
  if (f.foot == Foot::from) return squared_between(p.exact, a);
  if (f.foot == Foot::to) return squared_between(p.exact, b);
  // (d x e)^2 / |d|^2, d over a.w b.w and e over a.w p.w.
  const BigInteger cross = f.d.x * f.e.y - f.d.y * f.e.x, w = a.w * p.exact.w;
  return {cross * cross, f.length * w * w};
}

HomogeneousPoint nearest_on(const ExactPoint& p, const Segment& s) {
  const HomogeneousPoint &a = s.from->exact, &b = s.to->exact;
  const FootOf f(p.exact, a, b);
  if (f.foot == Foot::from) return a;
  if (f.foot == Foot::to) return b;
  // a + t (b - a), t = along b.w / (length p.w), b - a = d / (a.w b.w).
  const BigInteger den = f.length * p.exact.w;
  return exact::in_lowest_terms({a.x * den + f.along * f.d.x, a.y * den + f.along * f.d.y, a.w * den});
}

Interval squared_distance_bounds(const ExactPoint& p, const Segment& s) {
  const Interval ex = p.x - s.from->x, ey = p.y - s.from->y, fx = p.x - s.to->x, fy = p.y - s.to->y;
  const Interval to_from = square(ex) + square(ey), to_to = square(fx) + square(fy);
  if (s.from == s.to) return to_from;
  const Interval dx = s.to->x - s.from->x, dy = s.to->y - s.from->y;
  const Interval along = dx * ex + dy * ey, beyond = dx * fx + dy * fy;
  if (along.high() <= 0) return to_from;
  if (beyond.low() >= 0) return to_to;
  const Interval to_line = square(dx * ey - dy * ex) / (square(dx) + square(dy));
  if (along.low() >= 0 && beyond.high() <= 0) return to_line;
  // Above the distance from the line, below those from both ends.
  return {to_line.is_whole() ? 0.0 : std::max(0.0, to_line.low()), std::min(to_from.high(), to_to.high())};
}

double rough_distance(Point p, const Segment& s) {
  const Point a = s.from->near, b = s.to->near;
  const double dx = b.x - a.x, dy = b.y - a.y, size = std::max(std::abs(dx), std::abs(dy));
  if (!(size > 0)) return std::hypot(a.x - p.x, a.y - p.y);
  const double u = dx / size, w = dy / size;
  const double t = std::clamp(((p.x - a.x) * u + (p.y - a.y) * w) / (u * u + w * w) / size, 0.0, 1.0);
  return std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y);
}

}  // namespace dymsum::check
