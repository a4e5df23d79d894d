#include "cspace/queries/interval_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dymsum::cspace {
namespace {

// The error of u and v is this times the sizes of their terms: scalar and cross products with unit vectors (5 + 3
// each), turned (2 * 4), and sums. What is made of two of them errs by this times the square of all sizes: both, the
// product and sums.
constexpr double kCoordinate = exact::rounding_bound(8 + 8 + 2, 512), kSquare = exact::rounding_bound(2 * 18 + 6, 512);
// A bound so near to the value is not improved any more: any fraction is right.
constexpr double kNearEnough = 1 - 0x1p-34;

double square(double v) { return v * v; }

// The least value of value + 2 slope y + curvature y^2 for y in [low, high].
double least_of(double value, double slope, double curvature, double low, double high) {
  const auto at = [&](double y) { return value + y * (2 * slope + curvature * y); };
  if (curvature > 0) return at(std::clamp(-slope / curvature, low, high));
  return std::min(at(low), at(high));
}

}  // namespace

struct IntervalDistance::Position {
  SmallRotation t;
  double h = 0, k = 0, u = 0, v = 0, angle = 0;
};

IntervalDistance::IntervalDistance(const PatchForm& form, const PatchInterval& interval,
                                   const DistanceQuestion& question, double off)
    : interval_(interval),
      whole_(question.whole_edges),
      length_(form.own.length),
      off_(off),
      weight_(question.weight),
      weight2_(square(question.weight)) {
  const ContactLine& l = form.own;
  const Point gap = question.from - l.start.a, b = l.start.b, e = l.unit;
  // The vector that turns, and the one that does not; by the edge's direction at the angle 0.
  double p = 0, q = 0;
  if (l.turns) {
    p = dot(gap, e);
    q = cross(e, gap);
    u0_ = -dot(b, e);
    v0_ = -cross(e, b);
  } else {
    p = -dot(b, e);
    q = cross(e, b);
    u0_ = dot(gap, e);
    v0_ = cross(e, gap);
    sign_ = -1;
  }
  h_ = interval.c * p + interval.s * q;
  k_ = interval.c * q - interval.s * p;
  tolerance_ = kCoordinate * (std::abs(u0_) + std::abs(v0_) + std::abs(h_) + std::abs(k_));
}

IntervalDistance::Position IntervalDistance::at(double x) const {
  Position r{SmallRotation(x)};
  r.h = h_ * r.t.c + k_ * r.t.s;
  r.k = k_ * r.t.c - h_ * r.t.s;
  r.u = u0_ + r.h;
  r.v = v0_ + sign_ * r.k;
  r.angle = off_ + x;
  return r;
}

double IntervalDistance::end_at(const EndCurve& curve, double fixed, const SmallRotation& t) const {
  return whole_ ? fixed : curve.value(t);
}

EndCurve::Ranges IntervalDistance::end_ranges(const EndCurve& curve, double fixed, double low, double high) const {
  if (whole_) return {{fixed, fixed}, {}, {}, true, 0, 0};
  return curve.ranges(low, high);
}

IntervalDistance::Nearest IntervalDistance::nearest(double x) const {
  const Position p = at(x);
  const double left = end_at(interval_.left, 0, p.t), right = end_at(interval_.right, length_, p.t);
  Nearest n;
  n.along = p.u;
  if (p.u > right) {
    n.along = right;
    n.error = whole_ ? 0 : interval_.right.error(p.t);
  }
  if (p.u < left) {
    n.along = left;
    n.error = whole_ ? 0 : interval_.left.error(p.t);
  }
  n.distance = std::sqrt(square(p.u - n.along) + square(p.v) + weight2_ * square(p.angle));
  return n;
}

double IntervalDistance::drift(double x, double by) const {
  double speed = 0;
  for (const EndCurve* end : {&interval_.left, &interval_.right}) {
    const EndCurve::Ranges ranges = end->ranges(x - by, x + by);
    if (!ranges.known) return std::numeric_limits<double>::infinity();
    speed = std::max(speed, magnitude(ranges.first));
  }
  return by * speed;
}

// Whether the foot of the perpendicular is outside of an end, sign being that of u - end then. What is outside by less
// than the tolerance may count as inside, and the other way round.
IntervalDistance::Side IntervalDistance::side_of(const EndCurve& curve, double fixed, double sign,
                                                 const EndCurve::Ranges& end, Range u, Range speed, double low,
                                                 double high, Bound& bound) const {
  const Range over = sign * (u - end.value);
  if (over.low >= -tolerance_) return Side::outside;
  if (over.high <= tolerance_) return Side::inside;
  const Range faster = speed - end.first;
  if (!end.known || (faster.low <= 0 && faster.high >= 0)) return Side::unknown;
  const Position a = at(low), b = at(high);
  const double at_low = sign * (a.u - end_at(curve, fixed, a.t)), at_high = sign * (b.u - end_at(curve, fixed, b.t));
  if (std::min(at_low, at_high) >= -tolerance_) return Side::outside;
  if (std::max(at_low, at_high) <= tolerance_) return Side::inside;
  if (!bound.splits) bound.split = root(curve, fixed, low, high, sign * at_low, sign * at_high);
  bound.splits = true;
  return Side::splits;
}

// The parameter at which u meets the end, by false position (Illinois).
double IntervalDistance::root(const EndCurve& curve, double fixed, double low, double high, double at_low,
                              double at_high) const {
  double x = low;
  for (int k = 0; k < 12; ++k) {
    const double last = x;
    x = low + (high - low) * (at_low / (at_low - at_high));
    if (!(x > low && x < high) || x == last) break;
    const Position p = at(x);
    const double here = p.u - end_at(curve, fixed, p.t);
    if (std::abs(here) < tolerance_) break;
    if ((here > 0) == (at_low > 0)) {
      low = x;
      at_low = here;
      at_high /= 2;
    } else {
      high = x;
      at_high = here;
      at_low /= 2;
    }
  }
  return x;
}

// The square distance, half its slope and half its curvature at x.
IntervalDistance::Parabola IntervalDistance::parabola(Part part, double x) const {
  const Position p = at(x);
  Parabola r{square(p.v) + weight2_ * square(p.angle), -sign_ * p.v * p.h + weight2_ * p.angle,
             p.h * p.h - sign_ * p.k * p.v + weight2_};
  if (part == Part::line) return r;
  const EndCurve::Derivatives end = whole_ ? EndCurve::Derivatives{fixed(part), 0, 0} : curve(part).derivatives(p.t);
  const double gap = p.u - end.value, speed = p.k - end.first;
  r.value += gap * gap;
  r.slope += gap * speed;
  r.curvature += speed * speed + gap * (-p.h - end.second);
  return r;
}

// Half of it. v' = -sign h, v'' = -sign k, u' = k, u'' = -h, and h^2 + k^2 does not change: for an end that does not
// move along the edge a sine wave is left.
double IntervalDistance::least_curvature(Part part, Range h, Range k, const EndCurve::Ranges& end) const {
  const double reach = magnitude(h) + magnitude(k) + std::abs(u0_) + std::abs(v0_) + length_ + end.scale;
  const double size = square(reach) + weight2_;
  const auto falls = [&](double z) { return z * (v0_ + z); };
  const double most = std::max(falls(sign_ * k.low), falls(sign_ * k.high));
  if (part == Part::line) return least_square(h) - most + weight2_ - kSquare * size;
  if (end.first.low == 0 && end.first.high == 0) {
    const Range wave = (u0_ - end.value.low) * h + (sign_ * v0_) * k;
    return weight2_ - wave.high - kSquare * size;
  }
  const Range speed = k - end.first, gap = u0_ + (h - end.value), faster = gap * (-1.0 * h - end.second);
  const double moving = square(magnitude(speed)) + magnitude(faster);
  return least_square(speed) + faster.low + least_square(h) - most + weight2_ - kSquare * (size + moving);
}

IntervalDistance::Bound IntervalDistance::lower(double low, double high, double enough) const {
  const double midpoint = low + (high - low) / 2, half = std::max(high - midpoint, midpoint - low);
  const Position m = at(midpoint);
  const double h_off = half * (std::abs(m.k) + std::abs(m.h) * half / 2);
  const double k_off = half * (std::abs(m.h) + std::abs(m.k) * half / 2);
  const Range h{m.h - h_off, m.h + h_off}, k{m.k - k_off, m.k + k_off};
  const Range u = u0_ + h, v = v0_ + sign_ * k, angle{m.angle - half, m.angle + half};
  const EndCurve::Ranges left = end_ranges(interval_.left, 0, low, high);
  const EndCurve::Ranges right = end_ranges(interval_.right, length_, low, high);
  const double beside = std::max(std::max(0.0, left.value.low - u.high), u.low - right.value.high);
  const double simple = square(beside) + least_square(v) + weight2_ * least_square(angle);
  Bound bound{std::sqrt(simple), midpoint, false, 0};
  if (bound.distance >= enough) return bound;
  const Side at_left = side_of(interval_.left, 0, -1, left, u, k, low, high, bound);
  const Side at_right = side_of(interval_.right, length_, 1, right, u, k, low, high, bound);
  const Part part = at_left == Side::outside ? Part::left : at_right == Side::outside ? Part::right : Part::line;
  const EndCurve::Ranges& end = part == Part::right ? right : left;
  const double curvature = least_curvature(part, h, k, end);
  double x = midpoint, best = simple;
  for (int step = 0; step < 5; ++step) {
    const Parabola p = parabola(part, x);
    bound.x = x;
    best = std::max(best, least_of(p.value, p.slope, curvature, low - x, high - x));
    if (best >= p.value * kNearEnough) break;
    const double bend = std::max(p.curvature, curvature);
    const double next = bend > 0 ? std::clamp(x - p.slope / bend, low, high) : p.slope > 0 ? low : high;
    if (next == x) break;
    x = next;
  }
  const double error = std::max(left.known ? left.error : 0, right.known ? right.error : 0);
  bound.distance = std::max(bound.distance, std::sqrt(best) - error - tolerance_);
  return bound;
}

}  // namespace dymsum::cspace
