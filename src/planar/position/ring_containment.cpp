#include "planar/position/ring_containment.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "exact/rounding_bound.h"
#include "planar/position/position_signs.h"

namespace dymsum::planar {

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
