#include "exact/grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/doubles.h"

namespace dymsum::exact {

namespace {

constexpr int kNoExponent = std::numeric_limits<int>::max();

/// The exponent of the last bit of v, which is not zero.
inline int last_bit(double v) {
  const auto bits = base::bit_cast<std::uint64_t>(v);
  const int field = static_cast<int>(bits >> 52) & 0x7ff;
  constexpr std::uint64_t kHidden = std::uint64_t{1} << 52;
  const std::uint64_t m = field != 0 ? bits | kHidden : bits;  // sign and exponent lie above the last bit
  return std::max(field, 1) - 1075 + std::countr_zero(m);
}

int lowest_exponent(std::span<const double> values) {
  int lowest = kNoExponent;
  for (const double v : values)
    if (v != 0) lowest = std::min(lowest, last_bit(v));
  return lowest;
}

/// The smallest B with |a - b| <= 2^B (times 1), as an exponent; very negative when a == b.
int difference_exponent(double a, double b) {
  if (a == b) return std::numeric_limits<int>::min();
  int halved = 0;
  if (!std::isfinite(a - b)) {  // only values from 2^970 on overflow, so halving loses nothing
    a /= 2;
    b /= 2;
    halved = 1;
  }
  // TwoSum: a - b == difference + error exactly; additions of doubles never underflow
  const double difference = a - b;
  const double b_used = a - difference, a_used = difference + b_used;
  const double error = (a - a_used) - (b - b_used);
  int e = 0;
  const double m = std::frexp(difference, &e);  // 2^(e-1) <= |difference| < 2^e, and the exact value is at most 2^e
  const bool at_most_power = std::abs(m) == 0.5 && (m > 0 ? error <= 0 : error >= 0);
  return e - (at_most_power ? 1 : 0) + halved;
}

}  // namespace

Dyadic to_dyadic(double v) {
  assert(std::isfinite(v));
  if (v == 0) return {};
  const auto bits = base::bit_cast<std::uint64_t>(v);
  const int field = static_cast<int>(bits >> 52) & 0x7ff;
  std::uint64_t m = bits & ((std::uint64_t{1} << 52) - 1);
  if (field != 0) m |= std::uint64_t{1} << 52;
  const int zeros = std::countr_zero(m);
  const auto magnitude = static_cast<std::int64_t>(m >> zeros);
  return {v < 0 ? -magnitude : magnitude, std::max(field, 1) - 1075 + zeros};
}

int common_exponent(std::span<const double> values) { return common_exponent(values, {}); }

int common_exponent(std::span<const Point> points) {
  int lowest = kNoExponent;
  for (const Point p : points) {
    if (p.x != 0) lowest = std::min(lowest, last_bit(p.x));
    if (p.y != 0) lowest = std::min(lowest, last_bit(p.y));
  }
  return lowest == kNoExponent ? 0 : lowest;
}

int common_exponent(std::span<const double> xs, std::span<const double> ys) {
  const int lowest = std::min(lowest_exponent(xs), lowest_exponent(ys));
  return lowest == kNoExponent ? 0 : lowest;
}

int bits_needed(double max_abs, int exponent) { return bits_needed(max_abs, max_abs, 0.0, exponent); }

int bits_needed(double low, double high, double offset, int exponent) {
  assert(std::isfinite(low) && std::isfinite(high) && std::isfinite(offset));
  const int e = std::max(difference_exponent(low, offset), difference_exponent(high, offset));
  return e <= exponent ? 0 : e - exponent;
}

double grid_center(double low, double high, int exponent) {
  const double midpoint = low / 2 + high / 2;
  int e = 0;
  std::frexp(midpoint, &e);
  if (midpoint == 0) return 0;
  if (e - 53 >= exponent) return midpoint;  // its last bit is a multiple of the unit
  // |midpoint| < 2^e < 2^(exponent + 53): scaling is exact, or loses only bits below the unit
  const double center = std::ldexp(std::floor(std::ldexp(midpoint, -exponent)), exponent);
  return center == 0 ? 0 : center;
}

}  // namespace dymsum::exact
