#include "planar/motion/exact_angle.h"

#include <cmath>
#include <numbers>

#include "base/elementary.h"
#include "exact/rounding_bound.h"
#include "planar/motion/orientation.h"

namespace dymsum::planar {

using exact::AlgebraicRoot;
using exact::BigRational;

namespace {

int sign_of(const AlgebraicRoot& t) {
  if (t.low() > 0) return 1;
  if (t.high() < 0) return -1;
  return exact::compare(t, BigRational(0));
}

// The charts in the order of the angles: (-pi, -pi/2], (-pi/2, pi/2], (pi/2, pi].
int section(const ExactAngle& a) { return a.chart == 0 ? 1 : sign_of(a.t) > 0 ? 0 : 2; }

/// The error of angle_at: an arc tangent, pi and their sum err by less than 4 u each; and that of twice an arc tangent,
/// relatively.
constexpr double kTurned = exact::rounding_bound(12, 16), kArc = exact::rounding_bound(2, 4);

double angle_at(double t, int section) {
  const double theta = 2 * base::elementary::atan(t);
  return section == 1 ? theta : section == 0 ? theta - std::numbers::pi : theta + std::numbers::pi;
}

// Whether b comes before c on the way counter-clockwise from a, all the way round when c = a.
bool on_way(const ExactAngle& a, const ExactAngle& b, const ExactAngle& c) {
  const int ab = compare(a, b), bc = compare(b, c), ac = compare(a, c);
  if (ab == 0 || bc == 0) return false;
  if (ac == 0) return true;
  return ac < 0 ? ab < 0 && bc < 0 : ab < 0 || bc < 0;
}

}  // namespace

ExactAngle exact_angle(const Orientation& theta) {
  if (theta.is_half_turn()) return {1, AlgebraicRoot::rational(0)};
  const BigRational t = exact::exact_value(theta.tan_half());
  if (t > -1 && t <= 1) return {0, AlgebraicRoot::rational(t)};
  return {1, AlgebraicRoot::rational(BigRational(-1 / t))};
}

int compare(const ExactAngle& a, const ExactAngle& b) {
  const int difference = section(a) - section(b);
  if (difference != 0) return difference < 0 ? -1 : 1;
  return exact::compare(a.t, b.t);
}

EventAngle event_angle(const ExactAngle& angle) {
  EventAngle e;
  const int s = section(angle);
  e.theta = angle_at(angle.t.approx(), s);
  e.low = angle_at(angle.t.low(), s);
  e.high = angle_at(angle.t.high(), s);
  if (s != 1) {
    e.low -= kTurned;
    e.high += kTurned;
  } else if (e.low != 0 || e.high != 0) {
    e.low -= kArc * std::abs(e.low) + exact::kSubnormal;
    e.high += kArc * std::abs(e.high) + exact::kSubnormal;
  }
  if (const std::optional<BigRational> t = exact::rational_value(angle.t)) e.exact = orientation_at(angle.chart, *t);
  return e;
}

Orientation orientation_between(const ExactAngle& a, const ExactAngle& b) {
  for (const Orientation& simple :
       {Orientation(), *Orientation::of(1, 1), *Orientation::of(-1, 1), Orientation::half_turn()})
    if (on_way(a, exact_angle(simple), b)) return simple;
  // Both lie in one quarter, a perhaps at its start. Its chart ends with a quarter turn, so that b is in it; a is too
  // unless it is the -pi/2 before chart 0 or the pi/2 before chart 1.
  const int chart = b.chart;
  const AlgebraicRoot from = a.chart == chart ? a.t : AlgebraicRoot::rational(-1);
  return orientation_at(chart, exact::between(from, b.t));
}

}  // namespace dymsum::planar
