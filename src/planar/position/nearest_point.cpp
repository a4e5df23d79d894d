#include "planar/position/nearest_point.h"

#include <cmath>
#include <cstdint>

#include "planar/position/position_signs.h"

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

}  // namespace dymsum::planar
