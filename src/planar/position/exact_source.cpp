#include "planar/position/exact_source.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

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

namespace dymsum::planar {
namespace {

using base::DoublePair;

/// The pair is within 2^-105 of the number, relatively, where nothing underflows.
DoublePair pair_of(const exact::BigRational& v) {
  const double high = exact::round_to_double(v);
  if (!std::isfinite(high)) return {high, 0};
  // v - high without the greatest common divisors of rationals: high = digits 2^exponent.
  int exponent = 0;
  const exact::BigInteger digits = static_cast<std::int64_t>(std::ldexp(std::frexp(high, &exponent), 53));
  exponent -= 53;
  exact::BigInteger num = numerator(v), den = denominator(v);
  if (exponent >= 0) {
    num -= exact::BigInteger(digits << exponent) * den;
  } else {
    num = exact::BigInteger(num << -exponent) - digits * den;
    den <<= -exponent;
  }
  return {high, num.is_zero() ? 0 : exact::round_to_double(num, den)};
}

/// The error of origin + unit v is this times the sizes of both terms: unit and origin (2^-105), the product and the
/// sum.
constexpr double kMoved = 4 * base::kPairError;
/// Error terms below may underflow, sums above overflow.
constexpr double kLeast = 0x1p-800, kMost = 0x1p1000;
/// The range of a unit: beyond, it or its product with the integers could lose error terms.
constexpr double kLeastUnit = 0x1p-500, kMostUnit = 0x1p500;

/// The double nearest to origin + unit v, |v - exact| <= error, if this is proved. Rounding is monotone, so where both
/// ends of what is possible round to one double, all of it does; twice as much covers the roundings of these ends.
std::optional<double> nearest(DoublePair origin, DoublePair unit, DoublePair v, double error) {
  const DoublePair moved = unit * v, at = origin + moved;
  const double reach = std::abs(origin.high) + std::abs(moved.high);
  const double e = 2 * (error * std::abs(unit.high) + kMoved * reach);
  if (!(std::abs(at.high) > kLeast && reach < kMost)) return std::nullopt;
  if (at.high + (at.low + e) == at.high && at.high + (at.low - e) == at.high) return at.high;
  return std::nullopt;
}

}  // namespace

NearestPoint::NearestPoint(const ExactSource& source) : source_(source) {
  if (const auto frame = source.near_frame()) frame_ = {pair_of(frame->unit), pair_of(frame->x), pair_of(frame->y)};
  if (frame_ && !(frame_->unit.high > kLeastUnit && frame_->unit.high < kMostUnit)) frame_.reset();
}

Point NearestPoint::operator()(const SumVertex& vertex) const {
  if (const std::optional<Point> once = source_.rounded_once(vertex)) return *once;
  if (frame_) {
    const ExactSource::NearPosition v = source_.near(vertex);
    const auto x = nearest(frame_->x, frame_->unit, v.x, v.error), y = nearest(frame_->y, frame_->unit, v.y, v.error);
    if (x && y) return {*x, *y};
  }
  return make_spot(source_.position(vertex)).nearest;
}

namespace {

/// The error of a point on an edge is this times the largest coordinate: two products and their sum, whose fractions
/// add up to 1.
constexpr double kOnEdge = exact::rounding_bound(2, 4);
/// The error of the side of a point, besides what differences of coordinates err by that come from positions, is this
/// times the sum of both products: the roundings of two differences, of the product and of the difference of products.
constexpr double kSide = exact::rounding_bound(4, 8);

enum class Side { inside, outside, unsure };

/// A point of the inner ring: exact coordinates within `error` of x and y.
struct RoughPoint {
  double x, y, error;
};

/// A point on the edge from a to b, near 7/16 of the way: off the midpoint, where symmetric shapes tend to touch. Each
/// coordinate of 9/16 a + 7/16 b inherits at most at_error.
RoughPoint point_on_edge(const SumVertex& a, const SumVertex& b, double at_error) {
  const double x = 0.5625 * a.at.x + 0.4375 * b.at.x, y = 0.5625 * a.at.y + 0.4375 * b.at.y;
  const double largest = std::max({std::fabs(a.at.x), std::fabs(a.at.y), std::fabs(b.at.x), std::fabs(b.at.y)});
  return {x, y, at_error + kOnEdge * largest + exact::kUnderflow};
}

/// Parity of the ring's edges that cross the ray from q to the right, or unsure where an error bound does not decide.
/// Every difference of coordinates errs by at most `error`, outwards of what both positions err by, and its own
/// rounding, which does not change its sign. With E that error, ax by - ay bx errs by at most E (|ax| + |ay| + |bx| +
/// |by|) + 2 E^2 besides kSide.
Side rough_side(const std::vector<SumVertex>& ring, const RoughPoint& q, double at_error) {
  const double error = (at_error + q.error) * exact::kOutwards;
  bool inside = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point a = ring[k].at, b = ring[k + 1 == ring.size() ? 0 : k + 1].at;
    const double ay = a.y - q.y, by = b.y - q.y;
    if ((ay > error && by > error) || (ay < -error && by < -error)) continue;
    const double ax = a.x - q.x, bx = b.x - q.x;
    if (ax < -error && bx < -error) continue;
    if (!(std::fabs(ay) > error && std::fabs(by) > error)) return Side::unsure;
    if (ax > error && bx > error) {
      inside = !inside;
      continue;
    }
    const double left = ax * by, right = ay * bx, det = left - right;
    const double reach = std::fabs(ax) + std::fabs(ay) + std::fabs(bx) + std::fabs(by);
    const double bound = (error * reach + 2 * error * error) * exact::kOutwards +
                         kSide * (std::fabs(left) + std::fabs(right)) + exact::kUnderflow;
    if (!(std::fabs(det) > bound)) return Side::unsure;
    if ((det > 0) == (by > 0)) inside = !inside;  // q lies to the left of the edge taken upwards
  }
  return inside ? Side::inside : Side::outside;
}

std::vector<Spot> spots_of(const SumRing& ring, const ExactSource& source) {
  std::vector<Spot> spots;
  spots.reserve(ring.vertices.size());
  for (const SumVertex& v : ring.vertices) spots.push_back(make_spot(source.position(v)));
  return spots;
}

/// The point at a fraction of the way from a to b.
Spot between(const Spot& a, const Spot& b, const exact::BigRational& t) {
  return make_spot(Position{a.exact.x + t * (b.exact.x - a.exact.x), a.exact.y + t * (b.exact.y - a.exact.y)});
}

/// Tries inner's vertices, then points of its first edge. Rings that do not cross touch inside that edge only at
/// vertices of outer, so of one more point than outer has vertices, one lies off it.
bool contains_exactly(const std::vector<Spot>& outer, const std::vector<Spot>& inner) {
  for (const Spot& v : inner)
    if (const Location at = locate(outer, v); at != Location::boundary) return at == Location::inside;
  const auto points = static_cast<std::int64_t>(outer.size()) + 1;
  for (std::int64_t k = 1; k <= points; ++k) {
    const Spot q = between(inner[0], inner[1], exact::BigRational(k, points + 1));
    if (const Location at = locate(outer, q); at != Location::boundary) return at == Location::inside;
  }
  throw std::logic_error("ring_contains: the rings run along each other");
}

}  // namespace

RingBox box_of(const SumRing& ring, double at_error) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  RingBox box{kInfinity, kInfinity, -kInfinity, -kInfinity};
  for (const SumVertex& v : ring.vertices) {
    box.min_x = std::min(box.min_x, v.at.x);
    box.min_y = std::min(box.min_y, v.at.y);
    box.max_x = std::max(box.max_x, v.at.x);
    box.max_y = std::max(box.max_y, v.at.y);
  }
  // one step outwards covers the rounding of the widened bounds
  return {std::nextafter(box.min_x - at_error, -kInfinity), std::nextafter(box.min_y - at_error, -kInfinity),
          std::nextafter(box.max_x + at_error, kInfinity), std::nextafter(box.max_y + at_error, kInfinity)};
}

bool boxes_disjoint(const RingBox& a, const RingBox& b) {
  return a.max_x < b.min_x || b.max_x < a.min_x || a.max_y < b.min_y || b.max_y < a.min_y;
}

bool ring_contains(const SumRing& outer, const SumRing& inner, const ExactSource& source, double at_error) {
  constexpr std::size_t kTries = 4;
  const std::vector<SumVertex>& ring = inner.vertices;
  for (std::size_t i = 0; i < kTries; ++i) {
    const std::size_t k = i * ring.size() / kTries, next = k + 1 == ring.size() ? 0 : k + 1;
    const Side side = rough_side(outer.vertices, point_on_edge(ring[k], ring[next], at_error), at_error);
    if (side != Side::unsure) return side == Side::inside;
  }
  return contains_exactly(spots_of(outer, source), spots_of(inner, source));
}

}  // namespace dymsum::planar
