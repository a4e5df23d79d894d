// Exact integers of any size as a double and a power of two: where the integer itself lies beyond the range of doubles.
#pragma once

#include <cmath>

#include "exact/big.h"
#include "exact/int.h"

namespace dymsum::exact {

/// mantissa 2^exponent, 1/2 <= |mantissa| < 1; the mantissa of zero is 0.
struct BinaryParts {
  double mantissa = 0;
  int exponent = 0;

  /// The value times 2^shift, where that is a double that is not subnormal.
  double scaled(int shift) const { return std::ldexp(mantissa, exponent + shift); }
  bool is_zero() const { return mantissa == 0; }
};

inline BinaryParts binary_parts(double v, int shift = 0) {
  int exponent = 0;
  const double mantissa = std::frexp(v, &exponent);
  return {mantissa, exponent + shift};
}

/// A double within 2^-51 of the value, exactly where that has at most 53 binary digits. What is cut off first is below
/// 2^-100 of the value: no less than two whole limbs are left, and rounding them as to_double does errs by 2^-52.
template <int B>
BinaryParts binary_parts(const Int<B>& v) {
  if constexpr (B <= 960) {
    return binary_parts(to_double(v));
  } else {
    const auto magnitude = abs(v).raw();
    constexpr int kLimbs = limb_count(B);
    int top = kLimbs - 1;
    while (top > 0 && magnitude.w[static_cast<std::size_t>(top)] == 0) --top;
    const int first = top < 4 ? 0 : top - 3;
    Limbs<5> leading;  // four limbs, and a sign
    for (int i = first; i <= top; ++i)
      leading.w[static_cast<std::size_t>(i - first)] = magnitude.w[static_cast<std::size_t>(i)];
    const double size = limbs_to_double(leading);
    return binary_parts(sign(v) < 0 ? -size : size, 64 * first);
  }
}
inline BinaryParts binary_parts(const Big& v) {
  const BigInteger size = boost::multiprecision::abs(v.value());
  if (size == 0) return {};
  const auto bits = static_cast<int>(msb(size));
  const int cut = bits < 960 ? 0 : bits - 200;
  const double leading = to_double(Big(BigInteger(size >> static_cast<unsigned>(cut))));
  return binary_parts(sign(v) < 0 ? -leading : leading, cut);
}

}  // namespace dymsum::exact
