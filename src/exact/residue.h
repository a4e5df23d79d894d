// Exact integers modulo the prime 2^61 - 1: a value that every representation of a rational number shares, to find
// equal ones by.
#pragma once

#include <cstdint>
#include <type_traits>

#include "exact/big.h"
#include "exact/int.h"

namespace dymsum::exact {

/// A number below 2^61 - 1.
using Residue = std::uint64_t;
inline constexpr Residue kResiduePrime = (std::uint64_t{1} << 61) - 1;

/// v modulo the prime, for any 128 bits: v = a 2^61 + b, and 2^61 is 1.
constexpr Residue folded(u128 v) {
  std::uint64_t low = static_cast<std::uint64_t>(v) & kResiduePrime;
  low += static_cast<std::uint64_t>(v >> 61) & kResiduePrime;  // below 2^62
  low += static_cast<std::uint64_t>(v >> 122);                 // at most 2^6
  low = (low & kResiduePrime) + (low >> 61);
  return low >= kResiduePrime ? low - kResiduePrime : low;
}
constexpr Residue times(Residue a, Residue b) { return folded(static_cast<u128>(a) * b); }
constexpr Residue plus(Residue a, Residue b) {
  const Residue s = a + b;
  return s >= kResiduePrime ? s - kResiduePrime : s;
}
constexpr Residue minus(Residue a, Residue b) { return a >= b ? a - b : a + kResiduePrime - b; }

/// The factor with times(a, inverse(a)) == 1, by Fermat. Requires a != 0.
constexpr Residue inverse(Residue a) {
  Residue result = 1;
  for (std::uint64_t e = kResiduePrime - 2; e != 0; e >>= 1, a = times(a, a))
    if (e & 1) result = times(result, a);
  return result;
}

/// The residue of an exact integer.
template <int B>
Residue residue(const Int<B>& v) {
  if constexpr (B <= 62) {
    return v.raw() < 0 ? minus(0, folded(static_cast<u128>(-static_cast<i128>(v.raw()))))
                       : folded(static_cast<u128>(v.raw()));
  } else if constexpr (B <= 126) {
    return v.raw() < 0 ? minus(0, folded(static_cast<u128>(-v.raw()))) : folded(static_cast<u128>(v.raw()));
  } else {
    const Int<B> size = abs(v);
    Residue r = 0;
    for (int i = static_cast<int>(size.raw().w.size()); i-- > 0;)
      r = folded((static_cast<u128>(r) << 64) + size.raw().w[i]);
    return sign(v) < 0 ? minus(0, r) : r;
  }
}
inline Residue residue(const Big& v) {
  const auto r = static_cast<Residue>(boost::multiprecision::abs(v.value()) % kResiduePrime);
  return sign(v) < 0 ? minus(0, r) : r;
}

static_assert(times(inverse(12345), 12345) == 1 && plus(minus(3, 5), 2) == 0);

}  // namespace dymsum::exact
