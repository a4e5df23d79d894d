#include "cspace/motion/pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cspace/events/walked_rings.h"
#include "exact/rounding_bound.h"

namespace dymsum::planar {
namespace {

// The error of a cross product of differences that are known is this times |product| + |product|: two differences, the
// products and their difference.
constexpr double kCross = exact::rounding_bound(4, 8);
// The error of the length of a vector, which is at least that long: two squares, their sum, the root.
constexpr double kLength = exact::rounding_bound(3, 8);
// The error of a coordinate of x + R r is this times 2 |r| + |x|: cosine and sine err by 1 each, sqrt(2) |r| together,
// the products by |r| together, their difference and the sum by |r| and |x| + |r|.
constexpr double kPlaced = exact::rounding_bound(5, 8);
// The error of the distance of a vertex from an edge is this times M = span + reach + |x| + |y|; vectors from the
// edge's start to the vertex are at most sqrt(2) M long, and so are those to the foot. The fraction of the foot errs by
// 4 of numerator and denominator each and the quotient, which moves the foot by 9 sqrt(2) M; the difference of vector
// and foot errs by 4 sqrt(2), its length by 2 sqrt(2).
constexpr double kDistance = exact::rounding_bound(22, 32);

double largest(const std::vector<Point>& points) {
  double most = 0;
  for (const Point& p : points) most = std::max({most, std::abs(p.x), std::abs(p.y)});
  return most;
}

// The sign of (b - a) x (c - a), every coordinate within e; 0 when it is not proved. Differences err by 2 e, which the
// other one is multiplied with; a hundredth more covers the roundings of that.
int proved_side(Point a, Point b, Point c, double e) {
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  const double det = bx * cy - by * cx;
  const double bound = 2.02 * e * (std::abs(bx) + std::abs(by) + std::abs(cx) + std::abs(cy) + 4 * e) +
                       kCross * (std::abs(bx * cy) + std::abs(by * cx)) + exact::kUnderflow;
  return det > bound ? 1 : det < -bound ? -1 : 0;
}

bool boxes_apart(Point a, Point b, Point c, Point d, double e) {
  return std::max(a.x, b.x) + 2 * e < std::min(c.x, d.x) || std::max(c.x, d.x) + 2 * e < std::min(a.x, b.x) ||
         std::max(a.y, b.y) + 2 * e < std::min(c.y, d.y) || std::max(c.y, d.y) + 2 * e < std::min(a.y, b.y);
}

// The edges cross in their interiors, are apart, or it is not proved.
Pose::Overlap crossing(Point a, Point b, Point c, Point d, double e) {
  if (boxes_apart(a, b, c, d, e)) return Pose::Overlap::no;
  const int ac = proved_side(a, b, c, e), ad = proved_side(a, b, d, e);
  if (ac * ad > 0) return Pose::Overlap::no;
  const int ca = proved_side(c, d, a, e), cb = proved_side(c, d, b, e);
  if (ca * cb > 0) return Pose::Overlap::no;
  return ac * ad < 0 && ca * cb < 0 ? Pose::Overlap::yes : Pose::Overlap::unsure;
}

// Whether p, provably on no edge, lies inside; the parity of a ray upwards in these very doubles.
Pose::Overlap holds(const Outline& outline, const std::vector<Point>& at, Point p, double e) {
  bool inside = false;
  for (std::uint32_t k = 0; k < at.size(); ++k) {
    const Point a = at[k], b = at[outline.next[k]];
    if ((a.x <= p.x) == (b.x <= p.x)) continue;
    const int s = proved_side(a, b, p, e);
    if (s == 0) return Pose::Overlap::unsure;
    if (s == (a.x <= p.x ? -1 : 1)) inside = !inside;
  }
  return inside ? Pose::Overlap::yes : Pose::Overlap::no;
}

double distance(Point a, Point b, Point p) {
  const double dx = b.x - a.x, dy = b.y - a.y, px = p.x - a.x, py = p.y - a.y, l = dx * dx + dy * dy;
  const double t = l > 0 ? std::clamp((dx * px + dy * py) / l, 0.0, 1.0) : 0;
  return std::hypot(px - t * dx, py - t * dy);
}

}  // namespace

Outline::Outline(const Region& region) {
  const auto add = [&](const Ring& ring) {
    const auto first = static_cast<std::uint32_t>(vertices.size()), n = static_cast<std::uint32_t>(ring.size());
    rings.push_back(first);
    for (std::uint32_t k = 0; k < n; ++k) {
      vertices.push_back(ring[k]);
      next.push_back(first + (k + 1) % n);
      before.push_back(first + (k + n - 1) % n);
    }
  };
  for_each_ring(region, add);
}

Pose::Pose(const Region& robot, const Region& obstacle, double scale) : robot_(robot), obstacle_(obstacle) {
  for (Outline* outline : {&robot_, &obstacle_})
    for (Point& p : outline->vertices) p = {scale * p.x, scale * p.y};
  for (const Point& p : robot_.vertices) reach_ = std::max(reach_, std::hypot(p.x, p.y));
  reach_ *= 1 + kLength;
  span_ = largest(obstacle_.vertices);
  placed_.resize(robot_.vertices.size());
}

// The bound on the error of each coordinate.
double Pose::position(double x, double y, double c, double s, double slack) {
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    const Point r = robot_.vertices[k];
    placed_[k] = {x + (c * r.x - s * r.y), y + (s * r.x + c * r.y)};
  }
  return slack + kPlaced * (2 * reach_ + std::abs(x) + std::abs(y));
}

Pose::Overlap Pose::overlap(double x, double y, double c, double s, double slack) {
  const double e = position(x, y, c, s, slack);
  bool proved = true;
  for (std::uint32_t i = 0; i < placed_.size(); ++i)
    for (std::uint32_t j = 0; j < obstacle_.vertices.size(); ++j) {
      const Overlap o = crossing(placed_[i], placed_[robot_.next[i]], obstacle_.vertices[j],
                                 obstacle_.vertices[obstacle_.next[j]], e);
      if (o == Overlap::yes) return o;
      proved = proved && o == Overlap::no;
    }
  if (!proved) return Overlap::unsure;
  // The boundaries are apart: the interiors meet exactly if a ring of one lies inside the other.
  for (const std::uint32_t v : robot_.rings)
    if (const Overlap o = holds(obstacle_, obstacle_.vertices, placed_[v], e); o != Overlap::no) return o;
  for (const std::uint32_t v : obstacle_.rings)
    if (const Overlap o = holds(robot_, placed_, obstacle_.vertices[v], e); o != Overlap::no) return o;
  return Overlap::no;
}

Pose::Gap Pose::gap(double x, double y, double c, double s, double slack) {
  const double e = position(x, y, c, s, slack);
  Gap gap{std::numeric_limits<double>::infinity(), {}};
  for (std::uint32_t i = 0; i < placed_.size(); ++i)
    for (std::uint32_t j = 0; j < obstacle_.vertices.size(); ++j) {
      const double on_obstacle = distance(obstacle_.vertices[j], obstacle_.vertices[obstacle_.next[j]], placed_[i]);
      const double on_robot = distance(placed_[i], placed_[robot_.next[i]], obstacle_.vertices[j]);
      if (on_obstacle < gap.at_least) gap = {on_obstacle, {Contact::Kind::edge_of_p, j, i}};
      if (on_robot < gap.at_least) gap = {on_robot, {Contact::Kind::edge_of_q, j, i}};
    }
  const double rounding = kDistance * (span_ + reach_ + std::abs(x) + std::abs(y));
  gap.at_least = std::max(0.0, gap.at_least - 4 * e - rounding);
  return gap;
}

}  // namespace dymsum::planar
