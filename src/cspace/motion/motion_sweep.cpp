#include <algorithm>
#include <cmath>
#include <vector>

#include "base/poll.h"
#include "cspace/events/walked_rings.h"
#include "cspace/motion/pose.h"
#include "dymsum/motion.h"
#include "exact/rounding_bound.h"
#include "planar/motion/orientation.h"

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
