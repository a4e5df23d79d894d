#include "exact/interval.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "exact/big.h"

namespace dymsum::exact {

WideInterval WideInterval::of(double v) {
  if (!(std::abs(v) < 0x1p60)) return whole();
  // The parts of v in each word, the largest first; every difference is exact.
  WideInterval r;
  double rest = std::abs(v), unit = 1;
  for (int k = 4; k >= 0; --k, unit *= 0x1p-64) {
    const double part = std::floor(rest / unit);
    r.midpoint_.w[static_cast<std::size_t>(k)] = static_cast<std::uint64_t>(part);
    rest -= part * unit;
  }
  if (v < 0) r.midpoint_ = limbs_sub(Midpoint{}, r.midpoint_);
  r.radius_ = rest > 0 ? kUnit : 0;
  return r;
}

WideInterval WideInterval::around(const BigInteger& value, const BigInteger& error, long shift) {
  const long by = shift + kFractionBits;
  BigInteger units = abs(value);
  bool cut = false;
  if (by >= 0) {
    // Beyond this many bits it is too large, whatever its digits.
    if (!units.is_zero() && static_cast<long>(msb(units)) + by > 62 + kFractionBits) return whole();
    units <<= by;
  } else {
    const auto down = static_cast<unsigned long>(-by);
    cut = !units.is_zero() && lsb(units) < down;
    units >>= down;
  }
  WideInterval r;
  for (std::uint64_t& word : r.midpoint_.w) {
    word = static_cast<std::uint64_t>(units & BigInteger(~std::uint64_t{0}));
    units >>= 64;
  }
  if (!units.is_zero() || r.midpoint_.w[4] > kMost) return whole();
  if (value.sign() < 0) r.midpoint_ = limbs_sub(Midpoint{}, r.midpoint_);
  double radius = cut ? kUnit : 0;
  if (!error.is_zero()) {
    // error < 2^bits.
    const long bits = static_cast<long>(msb(error)) + 1 + shift;
    if (bits > 60) return whole();
    radius += bits < -kFractionBits ? kUnit : std::ldexp(1.0, static_cast<int>(bits));
  }
  return {r.midpoint_, radius * kOutwards};
}

namespace {

/// n < 2^size.
std::int64_t size_of(const BigInteger& n) { return n.is_zero() ? 0 : static_cast<std::int64_t>(msb(n)) + 1; }
BigInteger magnitude_of(const BigInteger& n) { return n.sign() < 0 ? BigInteger(-n) : n; }

/// The largest double that is not above n 2^e, or the smallest one not below it. Requires n >= 0. Infinite past the
/// range of doubles.
double rounded_double(const BigInteger& n, std::int64_t e, bool up) {
  const std::int64_t size = size_of(n);
  if (size + e > 1024) return std::numeric_limits<double>::infinity();
  const std::int64_t cut = std::max<std::int64_t>({size - 53, -1074 - e, 0});
  const BigInteger kept = cut >= size ? BigInteger(0) : BigInteger(n >> static_cast<unsigned>(cut));
  const bool exact = n.is_zero() || static_cast<std::int64_t>(lsb(n)) >= cut;
  const std::uint64_t leading = static_cast<std::uint64_t>(kept) + (up && !exact ? 1 : 0);
  return std::ldexp(static_cast<double>(leading), static_cast<int>(std::max<std::int64_t>(cut + e, -1074)));
}

}  // namespace

Ball::Ball(BigInteger centre, BigInteger radius, std::int64_t exponent, unsigned precision)
    : centre_(std::move(centre)), radius_(std::move(radius)), exponent_(exponent) {
  const std::int64_t excess = std::max(size_of(magnitude_of(centre_)), size_of(radius_)) - precision;
  if (excess > 0) move_to(exponent_ + excess);
}

// Cutting moves the centre by less than one unit, and rounds the radius up by one at most.
void Ball::move_to(std::int64_t exponent) {
  if (exponent <= exponent_) {
    const auto shift = static_cast<unsigned>(exponent_ - exponent);
    centre_ <<= shift;
    radius_ <<= shift;
  } else {
    const std::int64_t cut = exponent - exponent_;
    const bool all = cut > std::max(size_of(magnitude_of(centre_)), size_of(radius_));
    const bool exact =
        radius_.is_zero() && (centre_.is_zero() || static_cast<std::int64_t>(lsb(magnitude_of(centre_))) >= cut);
    const auto shift = static_cast<unsigned>(all ? 0 : cut);
    // Magnitudes are shifted: Boost 1.74 loses the sign of some negative numbers, as of -(2^64 + 1).
    const bool negative = centre_.sign() < 0;
    centre_ = all ? BigInteger(0) : BigInteger(magnitude_of(centre_) >> shift);
    if (negative) centre_ = -centre_;
    radius_ = all ? BigInteger(0) : BigInteger(radius_ >> shift);
    if (!exact) radius_ += 2;
  }
  exponent_ = exponent;
}

Ball Ball::sum(const Ball& a, const Ball& b, int sign_of_b, unsigned precision) {
  if (a.centre_.is_zero() && a.radius_.is_zero()) return {sign_of_b * b.centre_, b.radius_, b.exponent_, precision};
  if (b.centre_.is_zero() && b.radius_.is_zero()) return {a.centre_, a.radius_, a.exponent_, precision};
  // No operand is shifted to the left by more than the precision.
  const std::int64_t exponent =
      std::max(std::min(a.exponent_, b.exponent_), std::max(a.top(), b.top()) - static_cast<std::int64_t>(precision));
  Ball x = a, y = b;
  x.move_to(exponent);
  y.move_to(exponent);
  return {sign_of_b < 0 ? BigInteger(x.centre_ - y.centre_) : BigInteger(x.centre_ + y.centre_),
          BigInteger(x.radius_ + y.radius_), exponent, precision};
}

Ball Ball::product(const Ball& a, const Ball& b, unsigned precision) {
  BigInteger radius = a.radius_ * b.radius_;
  if (!a.radius_.is_zero()) radius += a.radius_ * magnitude_of(b.centre_);
  if (!b.radius_.is_zero()) radius += b.radius_ * magnitude_of(a.centre_);
  return {BigInteger(a.centre_ * b.centre_), std::move(radius), a.exponent_ + b.exponent_, precision};
}

// With centres m, n, radii r, s and |x - m| <= r, |y - n| <= s:
//   |x / y - m / n| = |(x - m) n - m (y - n)| / |y n| <= (r |n| + |m| s) / ((|n| - s) |n|).
std::optional<Ball> Ball::quotient(const Ball& a, const Ball& b, unsigned precision) {
  const BigInteger n = magnitude_of(b.centre_), least = n - b.radius_;
  if (least.sign() <= 0) return std::nullopt;
  const std::int64_t wanted = static_cast<std::int64_t>(precision) + size_of(n) -
                              std::max(size_of(magnitude_of(a.centre_)), size_of(a.radius_));
  const auto shift = static_cast<unsigned>(std::max<std::int64_t>(wanted, 0));
  const BigInteger m = a.centre_ << shift, r = a.radius_ << shift;
  BigInteger radius = 1;
  if (!r.is_zero() || !b.radius_.is_zero()) radius += (r * n + magnitude_of(m) * b.radius_) / BigInteger(least * n) + 1;
  return Ball(BigInteger(m / b.centre_), std::move(radius), a.exponent_ - b.exponent_ - shift, precision);
}

// Away from zero |sqrt x - sqrt m| = |x - m| / (sqrt x + sqrt m) <= r / floor(sqrt m), and one more for the floor.
Ball Ball::root(const Ball& a, unsigned precision) {
  const std::int64_t size = std::max(size_of(magnitude_of(a.centre_)), size_of(a.radius_));
  auto shift = static_cast<unsigned>(std::max<std::int64_t>(2 * static_cast<std::int64_t>(precision) - size, 0));
  if ((a.exponent_ - shift) % 2 != 0) ++shift;
  const std::int64_t exponent = (a.exponent_ - static_cast<std::int64_t>(shift)) / 2;
  const BigInteger m = a.centre_ << shift, r = a.radius_ << shift;
  BigInteger rest;
  if (m > r) {
    const BigInteger floor = floor_root(m, rest);
    const BigInteger radius = r / floor + (r.is_zero() ? 0 : 1) + (rest.is_zero() ? 0 : 1);
    return {floor, radius, exponent, precision};
  }
  const BigInteger half = floor_root(BigInteger(m + r), rest) / 2 + 1;
  return {half, half, exponent, precision};
}

std::optional<int> Ball::sign() const {
  if (radius_.is_zero()) return centre_.sign();
  if (magnitude_of(centre_) > radius_) return centre_.sign();
  return std::nullopt;
}

std::int64_t Ball::top() const {
  const BigInteger most = magnitude_of(centre_) + radius_;
  return most.is_zero() ? std::numeric_limits<std::int64_t>::min() : exponent_ + size_of(most);
}

bool Ball::is_narrow(unsigned bits) const {
  return radius_.is_zero() || BigInteger(radius_ << bits) <= magnitude_of(centre_);
}

Interval Ball::rounded_outwards() const {
  const BigInteger low = centre_ - radius_, high = centre_ + radius_;
  return {low.sign() < 0 ? -rounded_double(-low, exponent_, true) : rounded_double(low, exponent_, false),
          high.sign() < 0 ? -rounded_double(-high, exponent_, false) : rounded_double(high, exponent_, true)};
}

}  // namespace dymsum::exact
