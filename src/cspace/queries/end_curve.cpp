#include "cspace/queries/end_curve.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace dymsum::cspace {
namespace {

// The error of a value on the edge is this times the sizes of its terms. A wave's factors are sums of two products with
// a cosine and a sine (2 + 1 + 1), and those of x (2) take part as well: 4 + 2 + 1, for both terms, and two sums. The
// tangent of half of psi errs by what psi does (14), and by 8 for its quotient of a sum; product, sums and the sum with
// the gap's.
constexpr double kSlack = exact::rounding_bound(14 + 8 + 4, 32);
static_assert(2 * (4 + 2 + 1) + 2 <= 14 + 8 + 4);
// The errors of gap / sin(psi): the gap, the quotient; and of the sine, absolutely or times its terms: the parallel
// angle, an arc tangent of unit vectors (2 * 5 + 2), and the angle taken off.
constexpr double kGap = exact::rounding_bound(6, 32), kSine = exact::rounding_bound(14, 16);

}  // namespace

int nearest_parallel(const PatchEnd& end, double theta) {
  return static_cast<int>(std::lround((theta - end.parallel) / std::numbers::pi)) & 1;
}

double parallel_angle(const PatchEnd& end, int k) { return end.parallel + k * std::numbers::pi; }

EndCurve::EndCurve(const PatchEnd& end, double length, double reference) : length_(length) {
  constant_ = end.corner ? end.at : end.constant;
  if (end.corner) return;
  if (end.mixed) {
    const int k = nearest_parallel(end, reference);
    set_pole(end, k, std::remainder(reference - parallel_angle(end, k), 2 * std::numbers::pi));
    return;
  }
  kind_ = Kind::wave;
  const Turn turn(reference);
  first_ = end.cosine * turn.c + end.sine * turn.s;
  second_ = end.sine * turn.c - end.cosine * turn.s;
  slack_ = end.error + kSlack * (std::abs(constant_) + std::abs(end.cosine) + std::abs(end.sine));
}

EndCurve::EndCurve(const PatchEnd& end, double length, int k, double psi) : exact_(true), length_(length) {
  constant_ = end.constant;
  set_pole(end, k, psi);
}

void EndCurve::set_pole(const PatchEnd& end, int k, double psi) {
  kind_ = Kind::pole;
  first_ = end.tangent;
  gap_ = second_ = end.gap[static_cast<std::size_t>(k)];
  slack_ = kSlack * (std::abs(constant_) + std::abs(first_) + length_);
  psi_ = psi;
  cosine_ = std::cos(psi);
  sine_ = std::sin(psi);
}

double EndCurve::raw(const SmallRotation& x) const {
  if (kind_ == Kind::constant) return constant_;
  if (kind_ == Kind::wave) return constant_ + first_ * x.c + second_ * x.s;
  const Sines p = psi(x);
  const double smooth = constant_ - first_ * (p.s / (1 + p.c));
  return gap_ == 0 ? smooth : smooth + gap_ / p.s;
}

// psi and its sine err by kSine at most, or by kSine of their terms, which have one sign on the side of the reference;
// across the pole from there only as much as the terms. On the edge gap / sin(psi) is no longer than everything else
// together.
double EndCurve::error_at(double sine) const {
  if (kind_ != Kind::pole || gap_ == 0) return slack_;
  if (sine == 0) return std::numeric_limits<double>::infinity();
  const double fraction = std::min(std::abs(gap_ / sine), 2 * (length_ + std::abs(constant_) + std::abs(first_)));
  const double terms = exact_ ? std::abs(sine_) + std::abs(sine) : 1;
  return slack_ + fraction * (kGap + kSine * terms / std::abs(sine));
}

double EndCurve::error(const SmallRotation& x) const { return error_at(psi(x).s); }

EndCurve::Derivatives EndCurve::derivatives(const SmallRotation& x) const {
  if (kind_ == Kind::constant) return {constant_, 0, 0};
  if (kind_ == Kind::wave) {
    const double wave = first_ * x.c + second_ * x.s;
    return {constant_ + wave, second_ * x.c - first_ * x.s, -wave};
  }
  const Sines p = psi(x);
  const double t = p.s / (1 + p.c), half = (1 + t * t) / 2;
  Derivatives d{constant_ - first_ * t, -first_ * half, -first_ * half * t};
  if (gap_ != 0) {
    const double over = gap_ / p.s, cotangent = p.c / p.s;
    d.value += over;
    d.first -= over * cotangent;
    d.second += over * (1 / (p.s * p.s) + cotangent * cotangent);
  }
  return d;
}

Range EndCurve::range(double a, double b) const { return ranges(a, b).value; }

// Between 0 and pi, 1 / sin is monotone on either side of pi / 2, cos / sin^2 falls, and (1 + cos^2) / sin^3 behaves as
// 1 / sin does.
EndCurve::Ranges EndCurve::ranges(double a, double b) const {
  if (kind_ == Kind::constant) return {{constant_, constant_}, {}, {}, true, 0, 0};
  const SmallRotation u(a), v(b);
  if (kind_ == Kind::wave) {
    const double midpoint = (a + b) / 2, half = (b - a) / 2;
    const SmallRotation m(midpoint);
    const PointRange wave = turning({first_ * m.c + second_ * m.s, second_ * m.c - first_ * m.s}, half);
    const Range value = constant_ + wave.x;
    const Range wider{value.low - slack_, value.high + slack_};
    return {clamp(wider, 0, length_), wave.y, -1.0 * wave.x, true, slack_, slack_ / kSlack};
  }
  const Sines p = psi(u), q = psi(v);
  if (across_pole(p, q) || !(p.c > -0.5) || !(q.c > -0.5))
    return {{0, length_}, {}, {}, false, std::numeric_limits<double>::infinity(), 0};
  const Range t = between(p.s / (1 + p.c), q.s / (1 + q.c));
  const Range half = 0.5 * (1.0 + between(t.low * t.low, t.high * t.high));
  const Range wide_half{t.low <= 0 && t.high >= 0 ? 0.5 : half.low, half.high};
  Ranges r{constant_ + -first_ * t, -first_ * wide_half, -first_ * (wide_half * t), true, 0, slack_ / kSlack};
  if (gap_ != 0) {
    const double sign = p.s > 0 ? 1 : -1, s0 = std::abs(p.s), s1 = std::abs(q.s);
    const double most = p.c * q.c > 0 ? std::max(s0, s1) : 1, least = std::min(s0, s1);
    const auto second = [](double c, double s) { return (1 + c * c) / (s * s * s); };
    const double high = std::max(second(p.c, s0), second(q.c, s1));
    const double low = p.c * q.c > 0 ? std::min(second(p.c, s0), second(q.c, s1)) : 1;
    r.value = r.value + gap_ * (sign * Range{1 / most, 1 / least});
    r.first = r.first + -gap_ * between(p.c / (p.s * p.s), q.c / (q.s * q.s));
    r.second = r.second + gap_ * (sign * Range{low, high});
    r.error = error_at(least);
  } else {
    r.error = slack_;
  }
  r.value = clamp({r.value.low - r.error, r.value.high + r.error}, 0, length_);
  return r;
}

// Near the pole gap / sin(psi) exceeds all that would be left on the edge.
Range EndCurve::possible(double a, double b) const {
  if (kind_ != Kind::pole || gap_ == 0) return {a, b};
  const double near = std::abs(gap_) / (2 * (length_ + std::abs(constant_) + std::abs(first_)));
  const double from = a + psi_, to = b + psi_;
  if (to <= 0 || -from > to) return to > -near && from < -near ? Range{a, -near - psi_} : Range{a, b};
  return from < near && to > near ? Range{near - psi_, b} : Range{a, b};
}

}  // namespace dymsum::cspace
