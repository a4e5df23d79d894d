#include "patch_distance.h"

#include <algorithm>
#include <cmath>

namespace dymsum::apps {
namespace {

double square(double v) { return v * v; }
double least_square(Range r) { return r.low > 0 ? square(r.low) : r.high < 0 ? square(r.high) : 0; }
PointRange from_to(const PointRange& a, Point b) { return {Range{b.x, b.x} - a.x, Range{b.y, b.y} - a.y}; }

}  // namespace

// The square distance to a point or a line that moves, without the share of the angle: its value in the middle, a lower
// bound of its values, and the range of its derivative.
struct PatchDistance::Slope {
  double middle = 0, least = 0;
  Range derivative;
};

// Where the ends are along the line matters only if the nearest point may be one of them.
PatchPoint PatchDistance::nearest(std::uint32_t patch, double theta, double shift) const {
  const PatchForm& form = forms_[patch];
  const Turn turn(theta);
  const PlacedEnd a = forms_.end_at(form, form.left, theta, turn), b = forms_.end_at(form, form.right, theta, turn);
  const Point s = place(form.own.start, turn), d = direction(form.own, turn);
  const double length = std::sqrt(dot(d, d)), at = dot(from_ - s, d) / length;
  const double from = dot(a.at - s, d) / length, to = dot(b.at - s, d) / length;
  double error = 0x1p-45 * forms_.size(), along = at;
  if (at < from + a.error) error += 2 * a.error, along = std::max(at, from);
  if (at > to - b.error) error += 2 * b.error, along = std::min(along, to);
  const Point foot{s.x + along / length * d.x, s.y + along / length * d.y}, gap = foot - from_;
  return {std::hypot(gap.x, gap.y, weight_ * (theta + shift - theta_)), error, foot, theta};
}

PatchDistance::Slope PatchDistance::to_point(const PatchForm& form, const PatchEnd& end, double theta, const Turn& turn,
                                             const MovingRange& range) const {
  const PointRange gap = from_to(range.at, from_);
  const PlacedEnd placed = forms_.end_at(form, end, theta, turn);
  const Point now = placed.at - from_;
  const double least_now = std::max(0.0, std::hypot(now.x, now.y) - 2 * placed.error);
  return {square(least_now), least_square(gap.x) + least_square(gap.y), -2.0 * dot(gap, range.speed)};
}

// The signed distance n . (q - a - R b) to the line, its normal n turning with it or not.
PatchDistance::Slope PatchDistance::to_line(const PatchForm& form, const Turn& turn, double half) const {
  const ContactLine& l = form.own;
  const double length = std::hypot(l.along.x, l.along.y);
  const Point n{-l.along.y / length, l.along.x / length}, gap = from_ - l.start.a;
  double now = 0;
  Range speed;
  if (l.turns) {
    const Point m = turn * n;
    now = dot(m, gap) - dot(n, l.start.b);
    const PointRange faster = turning(quarter(m), half);
    speed = gap.x * faster.x + gap.y * faster.y;
  } else {
    const Point arm = turn * l.start.b;
    now = dot(n, gap) - dot(n, arm);
    const PointRange faster = turning(quarter(arm), half);
    speed = -n.x * faster.x + -n.y * faster.y;
  }
  const double most = half * magnitude(speed);
  const Range values{now - most, now + most};
  return {now * now, least_square(values), 2.0 * (values * speed)};
}

// No part of a segment is nearer than its line, nor than its end where all of it lies behind that.
PatchDistance::Bound PatchDistance::lower(std::uint32_t patch, double middle, double half, double shift) const {
  const PatchForm& form = forms_[patch];
  const Turn turn(middle);
  const MovingRange a = forms_.end_within(form, form.left, middle, turn, half);
  const MovingRange b = forms_.end_within(form, form.right, middle, turn, half);
  const Point d = direction(form.own, turn);
  const PointRange along = form.own.turns ? turning(d, half) : PointRange{{d.x, d.x}, {d.y, d.y}};
  const Range behind_left = dot(from_to(a.at, from_), along), behind_right = dot(from_to(b.at, from_), along);
  const bool before = a.known && behind_left.high <= 0, after = b.known && behind_right.low >= 0;
  const bool beside = behind_left.low >= 0 && behind_right.high <= 0;
  const Slope s = before  ? to_point(form, form.left, middle, turn, a)
                  : after ? to_point(form, form.right, middle, turn, b)
                          : to_line(form, turn, half);
  const double w = weight_ * weight_, angle = middle + shift - theta_;
  const Range angles{angle - half, angle + half}, slope = s.derivative + 2 * w * angles;
  const double now = s.middle + w * angle * angle;
  if ((before || after || beside) && (slope.low >= 0 || slope.high <= 0)) {
    const double end = slope.low >= 0 ? middle - half : middle + half;
    const PatchPoint at = nearest(patch, end, shift);
    if (std::isfinite(at.error)) return {square(std::max(0.0, at.distance - at.error)), true, end};
  }
  return {std::max(now - half * magnitude(slope), s.least + w * least_square(angles)), false, 0};
}

}  // namespace dymsum::apps
