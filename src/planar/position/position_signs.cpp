#include "planar/position/position_signs.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "exact/rounding_bound.h"

namespace dymsum {

ExactSource::Homogeneous ExactSource::homogeneous(const SumVertex& vertex) const {
  return planar::homogeneous(position(vertex));
}

ExactSource::NearPosition ExactSource::near(const SumVertex&) const {
  throw std::logic_error("ExactSource: near() without a frame");
}

int ExactSource::compare_x(const SumVertex& a, const SumVertex& b) const {
  return planar::compare(position(a).x, position(b).x);
}

int ExactSource::compare_y(const SumVertex& a, const SumVertex& b) const {
  return planar::compare(position(a).y, position(b).y);
}

namespace planar {

namespace {

/// The determinant of three positions, each scaled by its positive w, so that only integers are multiplied.
int orientation_exact(const Position& a, const Position& b, const Position& c) {
  const Homogeneous p = homogeneous(a), q = homogeneous(b), r = homogeneous(c);
  const exact::BigInteger qx = q.x * p.w - p.x * q.w, qy = q.y * p.w - p.y * q.w;
  const exact::BigInteger rx = r.x * p.w - p.x * r.w, ry = r.y * p.w - p.y * r.w;
  const exact::BigInteger left = qx * ry, right = qy * rx;
  const int c_sign = left.compare(right);
  return (c_sign > 0) - (c_sign < 0);
}

int compare_doubles(double a, double b) { return (a > b) - (a < b); }

}  // namespace

Homogeneous homogeneous(const Position& p) {
  Homogeneous h{numerator(p.x), numerator(p.y), denominator(p.x)};
  exact::BigInteger yd = denominator(p.y);
  if (h.w == yd) return h;
  const exact::BigInteger common = gcd(h.w, yd);
  yd /= common;
  h.x *= yd;
  h.y *= h.w / common;
  h.w *= yd;
  return h;
}

Position reduced(const Homogeneous& p) { return {{p.x, p.w}, {p.y, p.w}}; }

int compare(const exact::BigRational& a, const exact::BigRational& b) {
  const exact::BigInteger an = numerator(a), bn = numerator(b), ad = denominator(a), bd = denominator(b);
  const int order = ad == bd ? an.compare(bn) : exact::BigInteger(an * bd).compare(exact::BigInteger(bn * ad));
  return (order > 0) - (order < 0);
}

int compare(const Position& a, const Position& b) {
  const int order = compare(a.x, b.x);
  return order != 0 ? order : compare(a.y, b.y);
}

Spot make_spot(Position p) {
  const Point nearest{exact::round_to_double(p.x), exact::round_to_double(p.y)};
  return {std::move(p), nearest};
}

Spot make_spot(Point p) { return {{exact::exact_value(p.x), exact::exact_value(p.y)}, {p.x + 0.0, p.y + 0.0}}; }

int compare_x(const Spot& a, const Spot& b) {
  const int order = compare_doubles(a.nearest.x, b.nearest.x);
  return order != 0 ? order : compare(a.exact.x, b.exact.x);
}

int compare_y(const Spot& a, const Spot& b) {
  const int order = compare_doubles(a.nearest.y, b.nearest.y);
  return order != 0 ? order : compare(a.exact.y, b.exact.y);
}

int compare(const Spot& a, const Spot& b) {
  const int order = compare_x(a, b);
  return order != 0 ? order : compare_y(a, b);
}

// Let u = 2^-53 and X the largest |x|. Each nearest x errs by at most u X (normal range), so a difference of two errs
// by at most 2 u X, plus u |difference| <= 2 u X for its own rounding: ex = 4 u X. With ey alike, the products err by
// at most ex (|qy| + |ry|) + ey (|qx| + |rx|) + 2 ex ey, and rounding adds 3 u (|qx ry| + |qy rx|). All is doubled to
// cover the rounding of the bound itself. kSubnormal covers coordinates rounded to subnormals, kUnderflow products that
// underflow. Infinite or NaN values fail the last comparison.
int orientation_filtered(Point a, Point b, Point c) {
  constexpr double u = exact::kRoundoff;
  const double ex = 4 * u * std::max({std::fabs(a.x), std::fabs(b.x), std::fabs(c.x)}) + exact::kSubnormal;
  const double ey = 4 * u * std::max({std::fabs(a.y), std::fabs(b.y), std::fabs(c.y)}) + exact::kSubnormal;
  const double qx = b.x - a.x, qy = b.y - a.y, rx = c.x - a.x, ry = c.y - a.y;
  const double left = qx * ry, right = qy * rx;
  const double bound = 2 * (ex * (std::fabs(qy) + std::fabs(ry)) + ey * (std::fabs(qx) + std::fabs(rx)) + 2 * ex * ey +
                            3 * u * (std::fabs(left) + std::fabs(right)));
  const double det = left - right;
  if (!(std::fabs(det) > bound + exact::kUnderflow)) return 0;
  return det > 0 ? 1 : -1;
}

int orientation(const Spot& a, const Spot& b, const Spot& c) {
  const int sign = orientation_filtered(a.nearest, b.nearest, c.nearest);
  return sign != 0 ? sign : orientation_exact(a.exact, b.exact, c.exact);
}

bool on_segment(const Spot& a, const Spot& b, const Spot& c) {
  const bool forward = compare(a, b) < 0;
  const Spot& low = forward ? a : b;
  const Spot& high = forward ? b : a;
  return compare(low, c) <= 0 && compare(c, high) <= 0 && orientation(a, b, c) == 0;
}

bool cross_properly(const Spot& a, const Spot& b, const Spot& c, const Spot& d) {
  const auto apart = [](double p, double q, double r, double s) { return std::max(p, q) < std::min(r, s); };
  if (apart(a.nearest.x, b.nearest.x, c.nearest.x, d.nearest.x) ||
      apart(c.nearest.x, d.nearest.x, a.nearest.x, b.nearest.x) ||
      apart(a.nearest.y, b.nearest.y, c.nearest.y, d.nearest.y) ||
      apart(c.nearest.y, d.nearest.y, a.nearest.y, b.nearest.y))
    return false;
  return orientation(a, b, c) * orientation(a, b, d) < 0 && orientation(c, d, a) * orientation(c, d, b) < 0;
}

// A ray to the right; an edge counts when exactly one of its ends lies strictly above q.
Location locate(std::span<const Spot> ring, const Spot& q) {
  bool inside = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Spot& a = ring[k];
    const Spot& b = ring[k + 1 == ring.size() ? 0 : k + 1];
    const int ya = compare_y(a, q), yb = compare_y(b, q);
    if (ya == 0 && compare_x(a, q) == 0) return Location::boundary;
    if (ya == 0 && yb == 0 && compare_x(a, q) * compare_x(b, q) < 0) return Location::boundary;
    if ((ya > 0) == (yb > 0)) continue;
    const int side = orientation(a, b, q);
    if (side == 0) return Location::boundary;
    if ((side > 0) == (yb > 0)) inside = !inside;
  }
  return inside ? Location::inside : Location::outside;
}

Location locate(const std::vector<std::vector<Spot>>& rings, const Spot& q) {
  bool inside = false;
  for (const std::vector<Spot>& ring : rings) {
    const Location location = locate(ring, q);
    if (location == Location::boundary) return location;
    if (location == Location::inside) inside = !inside;
  }
  return inside ? Location::inside : Location::outside;
}

}  // namespace planar
}  // namespace dymsum
