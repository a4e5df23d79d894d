#include "cspace/motion/motion_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/poll.h"
#include "cspace/events/walked_rings.h"
#include "dymsum/motion.h"
#include "exact/rounding_bound.h"
#include "planar/motion/orientation.h"

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

namespace dymsum {
namespace {

using planar::Pose;

// The error of a + t d between a and b, with d = b - a rounded, is this times |d| + 4 for the angle, which is reduced
// to at most pi first (2), and times |a| + |b| for a coordinate; d, the product and the sum.
constexpr double kAngle = exact::rounding_bound(2 + 3, 8), kCoordinate = exact::rounding_bound(3, 8);

double largest(const Region& region) {
  const auto [x0, y0, x1, y1] = bounds(region);
  return std::max({std::abs(x0), std::abs(y0), std::abs(x1), std::abs(y1)});
}

// A power of two that makes the largest coordinate at least 1: squares do not underflow then, and it is exact.
double scale_for(const Region& robot, const Region& obstacle, const Configuration& a, const Configuration& b) {
  const double most =
      std::max({largest(robot), largest(obstacle), std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
  return most > 0 && most < 1 ? std::ldexp(1.0, std::min(1000, -std::ilogb(most))) : 1;
}

// The way from a to b, poses in doubles.
class Sweep {
 public:
  /// Everything is seen `scale` times as large.
  Sweep(const Region& robot, const Region& obstacle, const Configuration& from, const Configuration& to, double scale)
      : pose_(robot, obstacle, scale) {
    const Point a{scale * from.x, scale * from.y}, b{scale * to.x, scale * to.y};
    a_ = {a.x, a.y, planar::reduced_angle(from.theta)};
    d_ = {b.x - a.x, b.y - a.y, to.theta - from.theta};
    way_ = std::hypot(d_.x, d_.y);
    arc_ = pose_.reach() * std::abs(d_.theta);
    // Doubles determine no angle on so long a path: that of the start stands for any.
    any_angle_ = std::abs(d_.theta) > 0x1p50;
    if (any_angle_) d_.theta = 0;
    // Rounding of the angle turns the robot a little, that of the position moves it.
    slack_ = kAngle * (std::abs(d_.theta) + 4) * pose_.reach() +
             kCoordinate * (std::abs(a.x) + std::abs(b.x) + std::abs(a.y) + std::abs(b.y));
  }

  Result<MotionCheck> run(const MotionOptions& options, const Progress& progress) {
    // Intervals still to be examined, the earliest on top.
    std::vector<std::pair<double, double>> open{{0.0, 1.0}};
    while (!open.empty()) {
      const auto [low, high] = open.back();
      if (progress && check_.poses % kBetween == 0 && !progress("poses", low)) return cancelled();
      open.pop_back();
      const double midpoint = 0.5 * (low + high);
      const Pose::Overlap here = overlap(midpoint);
      if (here == Pose::Overlap::no && gap_.at_least > reached(0.5 * (high - low))) continue;
      if (check_.poses >= options.most_poses) return undecided(low, open.empty() ? high : 1);
      if (high - low <= options.resolution || midpoint <= low || midpoint >= high) return ended(low, high, here);
      open.push_back({midpoint, high});
      open.push_back({low, midpoint});
    }
    return check_;
  }

 private:
  // No point of the robot moves farther in this fraction of the way: on its arc never more than across the circle.
  double reached(double fraction) const {
    return (fraction * way_ + std::min(2 * pose_.reach(), fraction * arc_)) * exact::kOutwards + 4 * fraction * slack_;
  }

  Pose::Overlap overlap(double t) {
    ++check_.poses;
    const double x = a_.x + t * d_.x, y = a_.y + t * d_.y, theta = a_.theta + t * d_.theta;
    const double c = std::cos(theta), s = std::sin(theta);
    Pose::Overlap o = pose_.overlap(x, y, c, s, slack_);
    if (o == Pose::Overlap::yes && any_angle_ && pose_.overlap(x, y, c, s, 2 * pose_.reach()) != o)
      o = Pose::Overlap::unsure;
    if (o == Pose::Overlap::no) gap_ = pose_.gap(x, y, c, s, slack_);
    return o;
  }

  void name_contact(double t) {
    const double x = a_.x + t * d_.x, y = a_.y + t * d_.y, theta = a_.theta + t * d_.theta;
    check_.contact = pose_.gap(x, y, std::cos(theta), std::sin(theta), slack_).nearest;
  }

  MotionCheck undecided(double low, double high) {
    check_.outcome = MotionCheck::Outcome::undecided;
    check_.low = low;
    check_.high = high;
    name_contact(low);
    return check_;
  }

  // An interval too short to halve and not free: a proved overlap shortly after tells a collision from grazing.
  MotionCheck ended(double low, double high, Pose::Overlap here) {
    const double width = high - low;
    undecided(low, high);
    double ahead = here == Pose::Overlap::yes ? 0.5 * (low + high) : high;
    for (int k = 0; k < kLook && here != Pose::Overlap::yes && ahead <= 1; ++k) {
      here = overlap(ahead);
      if (here == Pose::Overlap::no && gap_.at_least > reached(width)) break;
      if (here != Pose::Overlap::yes) ahead = std::min(ahead < 1 ? 1.0 : 2.0, ahead + 0.5 * width);
    }
    if (here == Pose::Overlap::yes) {
      check_.outcome = MotionCheck::Outcome::blocked;
      check_.high = std::min(ahead, 1.0);
    }
    return check_;
  }

  static constexpr std::uint64_t kBetween = 16;  // poses between questions whether to go on
  static constexpr int kLook = 64;               // half steps after the first touch that are searched for an overlap

  Pose pose_;
  Configuration a_, d_;
  double slack_ = 0, way_ = 0, arc_ = 0;
  bool any_angle_ = false;
  Pose::Gap gap_;
  MotionCheck check_;
};

}  // namespace

Result<MotionCheck> check_motion(const Region& robot, const Region& obstacle, const Configuration& a,
                                 const Configuration& b, const MotionOptions& options, const Progress& progress) {
  if (auto error = planar::refused_pair(robot, obstacle)) return *std::move(error);
  for (const double v : {a.x, a.y, a.theta, b.x, b.y, b.theta})
    if (!std::isfinite(v)) return Error{ErrorCode::not_finite, "a configuration is not finite", {}};
  for (const double v : {a.x, a.y, b.x, b.y})
    if (std::abs(v) > planar::kLargestCoordinate)
      return Error{ErrorCode::unsupported_operand, "a coordinate is larger than 2^400", {}};
  return Sweep(robot, obstacle, a, b, scale_for(robot, obstacle, a, b)).run(options, progress);
}

}  // namespace dymsum
