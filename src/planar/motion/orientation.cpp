#include "planar/motion/orientation.h"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/double_text.h"
#include "base/elementary.h"
#include "dymsum/cspace_obstacle.h"
#include "dymsum/orientation.h"
#include "dymsum/orientation_sum.h"
#include "exact/big.h"
#include "exact/rounding_bound.h"
#include "planar/motion/operand_pair.h"
#include "planar/operand/operand.h"
#include "planar/position/exact_source.h"
#include "planar/region/region.h"
#include "planar/sum/erode.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum {
namespace {

using exact::BigInteger;
using exact::BigRational;

double angle_of(const BigInteger& n, const BigInteger& d) {
  if (abs(n) <= abs(d)) return 2 * base::elementary::atan(exact::round_to_double(BigRational(n) / d));
  const double rest = 2 * base::elementary::atan(exact::round_to_double(BigRational(d) / n));
  return n.sign() * d.sign() < 0 ? -std::numbers::pi - rest : std::numbers::pi - rest;
}

// The rational with the smallest denominator in [a, b], 0 <= a < b.
BigRational simplest(const BigRational& a, const BigRational& b) {
  const BigInteger floor = numerator(a) / denominator(a);
  if (BigRational(floor) == a) return a;
  if (BigRational(BigInteger(floor + 1)) <= b) return BigRational(BigInteger(floor + 1));
  const BigRational inner = simplest(BigRational(1 / BigRational(b - floor)), BigRational(1 / BigRational(a - floor)));
  return BigRational(floor) + 1 / inner;
}

}  // namespace

Result<Orientation> Orientation::of(const Rational& tan_half) {
  const BigRational t = exact::exact_value(tan_half);
  if (t.sign() != 0 && (msb(abs(numerator(t))) >= exact::kMaxTextBits || msb(denominator(t)) >= exact::kMaxTextBits))
    return Error{ErrorCode::bad_rotation,
                 "numerator and denominator of the tangent of half an angle may have at most 4096 bits",
                 {}};
  return planar::orientation_of(t);
}

Result<Orientation> Orientation::of(std::int64_t n, std::int64_t d) {
  if (n != 0 && d == 0) return half_turn();
  if (d == 0) return Error{ErrorCode::bad_rotation, "0 / 0 is the tangent of no angle", {}};
  return of(*Rational::of(n, d));
}

Orientation Orientation::half_turn() {
  Orientation o;
  o.half_turn_ = true;
  o.radians_ = std::numbers::pi;
  return o;
}

Result<Orientation> Orientation::parse(std::string_view tan_half) {
  if (tan_half == "inf") return half_turn();
  const Result<BigRational> t = exact::number_in(tan_half, "tangent of half an angle", ErrorCode::bad_rotation);
  if (!t) return t.error();
  return of(exact::to_rational(*t));
}

Result<Orientation> Orientation::nearest(double radians) {
  if (!std::isfinite(radians))
    return Error{ErrorCode::bad_rotation, "an angle must be finite, not " + base::general_text(radians, 6), {}};
  const double theta = planar::reduced_angle(radians);
  if (std::abs(theta) == std::numbers::pi) return half_turn();
  if (std::abs(theta) == std::numbers::pi / 2) return of(theta > 0 ? 1 : -1, 1);
  const double t = std::tan(theta / 2);
  if (std::abs(t) <= 1) return planar::orientation_of(exact::exact_value(t));
  const double back = std::tan((theta > 0 ? std::numbers::pi - theta : -std::numbers::pi - theta) / 2);
  if (back == 0) return half_turn();
  return planar::orientation_of(BigRational(1 / exact::exact_value(back)));
}

// A fraction of the error that is allowed is kept for what tangents lose, and what the reduced angle errs by; below the
// shortest one the nearest orientation is as good.
constexpr double kFraction = 0.99, kReduced = exact::rounding_bound(4, 8), kShortest = exact::rounding_bound(16, 32);

Result<Orientation> Orientation::nearest(double radians, double error) {
  if (!std::isfinite(radians))
    return Error{ErrorCode::bad_rotation, "an angle must be finite, not " + base::general_text(radians, 6), {}};
  if (!(error >= kAngularError))
    return Error{
        ErrorCode::bad_rotation, "an angle is met within 2^-50, 8.9e-16 radians: its error cannot be less", {}};
  const double theta = planar::reduced_angle(radians), e = kFraction * error - kReduced;
  if (e < kShortest) return nearest(radians);
  if (std::abs(theta) <= e) return Orientation{};
  if (std::abs(theta) + e >= std::numbers::pi) return half_turn();
  // The tangent of half the rest to half a turn is one over that of half the angle.
  const bool far = std::abs(theta) > std::numbers::pi / 2;
  const double a = far ? std::numbers::pi - std::abs(theta) : std::abs(theta);
  BigRational t =
      simplest(exact::exact_value(std::tan((a - e > 0 ? a - e : 0) / 2)), exact::exact_value(std::tan((a + e) / 2)));
  if (far) {
    if (t.sign() == 0) return half_turn();
    t = 1 / t;
  }
  return planar::orientation_of(theta < 0 ? BigRational(-t) : t);
}

double reduced_radians(const Rational& radians) {
  const BigRational value = exact::exact_value(radians);
  if ((abs(numerator(value)) >> 1024) >= denominator(value))
    throw std::invalid_argument("reduced_radians: an angle of 2^1024 or more");
  return planar::reduced_angle(value);
}

double reduced_degrees(const Rational& degrees) { return planar::reduced_degrees(exact::exact_value(degrees)); }

const Rational& Orientation::tan_half() const {
  if (half_turn_) throw std::invalid_argument("Orientation::tan_half: half a turn has none");
  return tan_half_;
}

Orientation Orientation::inverse() const {
  if (half_turn_) return *this;
  return planar::orientation_of(BigRational(-exact::exact_value(tan_half_)));
}

// Half angles add: (d + n i) multiply.
Orientation operator*(const Orientation& a, const Orientation& b) {
  const auto [na, da] = planar::tan_half_of(a);
  const auto [nb, db] = planar::tan_half_of(b);
  const BigInteger d = da * db - na * nb, n = na * db + da * nb;
  return d == 0 ? Orientation::half_turn() : planar::orientation_of(exact::ratio(exact::Big(n), exact::Big(d)));
}

struct planar::OrientationInternals {
  static Orientation make(const BigRational& tan_half) {
    Orientation o;
    o.tan_half_ = exact::to_rational(tan_half);
    o.radians_ = angle_of(numerator(tan_half), denominator(tan_half));
    return o;
  }
};

namespace planar {

Orientation orientation_of(const BigRational& tan_half) { return OrientationInternals::make(tan_half); }

TanHalf tan_half_of(const Orientation& o) {
  if (o.is_half_turn()) return {1, 0};
  return {exact::numerator_of(o.tan_half()), exact::denominator_of(o.tan_half())};
}

// tan(x + pi / 2) = -1 / tan(x).
Orientation orientation_at(int chart, const BigRational& t) {
  if (chart == 0) return orientation_of(t);
  return t.sign() == 0 ? Orientation::half_turn() : orientation_of(BigRational(-1 / t));
}

LatticeScale turn_of(const Orientation& o, std::uint32_t op) {
  const auto [n, d] = tan_half_of(o);
  LatticeScale turn{BigInteger(d * d - n * n), BigInteger(d * d - n * n), BigInteger(d * d + n * n), op,
                    BigInteger(2 * n * d)};
  if ((turn.den & 1) == 0) {
    // n and d are odd: everything is even.
    turn.x /= 2;
    turn.y /= 2;
    turn.den /= 2;
    turn.turn /= 2;
  }
  return turn;
}

}  // namespace planar

}  // namespace dymsum

namespace dymsum::planar {
namespace {

// Angles are integers of steps of 2^-kBits. The largest double is less than 2^1024 quarter turns, and a quarter turn is
// known to one step: a reduced angle is known to 2^-128.
constexpr unsigned kBits = 1152, kGuard = 16;

// atan(1 / n) in steps of 2^-(kBits + kGuard): fewer than 2^9 terms, each cut off by less than two steps.
BigInteger arc_tangent_of_inverse(unsigned n) {
  BigInteger power = (BigInteger(1) << (kBits + kGuard)) / n, sum = power;
  for (unsigned k = 3; power != 0; k += 2) {
    power /= n * n;
    const BigInteger term = power / k;
    if (k % 4 == 3) sum -= term;
    else sum += term;
  }
  return sum;
}

// pi / 2 within a step; Machin: pi / 4 = 4 atan(1 / 5) - atan(1 / 239). 10 * 2^10 steps of the guard are less than 1.
const BigInteger& quarter_turn() {
  static const BigInteger quarter =
      BigInteger(8 * arc_tangent_of_inverse(5) - 2 * arc_tangent_of_inverse(239)) >> kGuard;
  return quarter;
}

// The steps below a positive angle: less than one is lost.
BigInteger steps_of(const BigRational& radians) { return (numerator(radians) << kBits) / denominator(radians); }

// What rounds to -pi is pi.
double rounded(const BigRational& theta) {
  const double nearest = exact::round_to_double(theta);
  return nearest == -std::numbers::pi ? std::numbers::pi : nearest;
}

constexpr std::array<double, 4> kQuarters{0, std::numbers::pi / 2, std::numbers::pi, -std::numbers::pi / 2};

}  // namespace

double reduced_angle(double radians) {
  if (std::abs(radians) <= std::numbers::pi) return radians == -std::numbers::pi ? std::numbers::pi : radians;
  return reduced_angle(exact::exact_value(radians));
}

double reduced_angle(const BigRational& radians) {
  static const BigRational half = exact::exact_value(std::numbers::pi);
  const BigRational magnitude = abs(radians);
  if (magnitude <= half) return rounded(radians);
  const BigInteger &quarter = quarter_turn(), steps = steps_of(magnitude);
  const BigInteger count = (2 * steps + quarter) / (2 * quarter), rest = steps - count * quarter;
  const int turned = static_cast<int>(BigInteger(count % 4)), sign = radians.sign();
  if (abs(rest) <= BigInteger(1) << (kBits - 50)) return kQuarters[static_cast<std::size_t>((4 + sign * turned) % 4)];
  const int quarters = turned == 3 || (turned == 2 && rest > 0) ? turned - 4 : turned;
  const BigInteger theta = sign * (quarters * quarter + rest);
  return rounded(BigRational(theta, BigInteger(1) << kBits));
}

double reduced_degrees(const BigRational& degrees) {
  const BigInteger whole = 360 * denominator(degrees);
  BigInteger rest = numerator(degrees) % whole;  // of the sign of the angle
  if (2 * rest > whole) rest -= whole;
  if (2 * rest <= -whole) rest += whole;
  const BigInteger quarters = 4 * rest;
  if (quarters % whole == 0) return kQuarters[static_cast<std::size_t>((4 + static_cast<int>(quarters / whole)) % 4)];
  return rounded(BigRational(quarters * quarter_turn(), whole << kBits));
}

using exact::AlgebraicRoot;

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

namespace dymsum {
namespace {

Result<PlanarSum> sum_of(const Region& p, const Region& q, const Orientation& theta, const SumOptions& options,
                         planar::PairOptions pair) {
  pair.min_tier_bits = planar::SumInternals::min_tier_bits(options);
  pair.spread = planar::Spread::any;
  const auto base = planar::pair_of_regions(p, q, pair);
  if (!base) return base.error();
  return planar::placed_sum((*base)->placed(theta), options);
}

}  // namespace

Result<PlanarSum> cspace_slice(const Region& robot, const Region& obstacle, const Orientation& theta,
                               const SumOptions& options) {
  return sum_of(obstacle, robot, theta, options, {.moved = 1, .reflect_q = true});
}

Result<PlanarSum> rotated_erode(const Region& p, const Region& q, const Orientation& theta, const SumOptions& options) {
  if (std::optional<Error> error = planar::not_erodible(p, q)) return *std::move(error);
  if (p.empty()) return minkowski_sum(p, q, options);  // empty too
  const auto base =
      planar::OperandPair::create({planar::make_operand(planar::complement_of(p, q, planar::Turning::any), 0),
                                   planar::prepared_operand(q, 1, true)},
                                  {}, 1, planar::SumInternals::min_tier_bits(options));
  if (!base) return base.error();
  Result<planar::SumState> computed = planar::compute_boundary((*base)->placed(theta), planar::options_inside(options));
  if (!computed) return computed.error();
  return planar::inside_of_frame(std::move(computed).value(), options);
}

Result<PlanarSum> rotated_sum(const Region& p, const Region& q, const Orientation& theta, const SumOptions& options) {
  return sum_of(p, q, theta, options, {.moved = 0});
}

}  // namespace dymsum
