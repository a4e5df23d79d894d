// Integers as pairs of doubles, with a relative error of at most 2^-104: exact up to 106 bits.
#pragma once

#include "base/double_pair.h"
#include "exact/big.h"
#include "exact/int.h"

namespace dymsum::exact {

using base::DoublePair;

/// The error of an integer as a pair, times itself.
inline constexpr double kIntegerPairError = 0x1p-104;

/// Requires |v| <= 2^126. Either double errs by 2^-53 of what it rounds.
inline DoublePair integer_pair(i128 v) {
  const auto high = static_cast<double>(v);
  return {high, static_cast<double>(v - static_cast<i128>(high))};
}

/// A magnitude: of more than 126 bits the leading ones, the rest is below 2^-125.
template <int N>
DoublePair limbs_pair(const Limbs<N>& magnitude) {
  static_assert(N >= 2 && 64 * N <= 1023);
  int top = N - 1;
  while (top > 1 && magnitude.w[top] == 0) --top;
  u128 leading = static_cast<u128>(magnitude.w[top]) << 64 | magnitude.w[top - 1];
  if (top == 1 && leading >> 126 == 0) return integer_pair(static_cast<i128>(leading));
  const int zeros = std::countl_zero(magnitude.w[top]);
  if (zeros != 0) leading = leading << zeros | (top > 1 ? magnitude.w[top - 2] >> (64 - zeros) : 0);
  const DoublePair pair = integer_pair(static_cast<i128>(leading >> 2));
  const double scale = power_of_two(64 * (top - 1) - zeros + 2);
  return {pair.high * scale, pair.low * scale};
}

template <int B>
DoublePair integer_pair(const Int<B>& v) {
  if constexpr (B <= 126) {
    return integer_pair(static_cast<i128>(v.raw()));
  } else {
    return sign(v) < 0 ? -limbs_pair((-v).raw()) : limbs_pair(v.raw());
  }
}

/// Requires |v| < 2^1000.
inline DoublePair integer_pair(const Big& v) {
  if (sign(v) == 0) return {};
  const BigInteger magnitude = boost::multiprecision::abs(v.value());
  const int shift = std::max(0, static_cast<int>(msb(magnitude)) - 125);
  const DoublePair pair = integer_pair(narrowed<Int<126>>(Big(BigInteger(magnitude >> shift))));
  const double scale = sign(v) < 0 ? -power_of_two(shift) : power_of_two(shift);
  return {pair.high * scale, pair.low * scale};
}

}  // namespace dymsum::exact
