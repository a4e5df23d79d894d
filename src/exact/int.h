// Integers whose type proves their size. Int<B> holds any integer v with |v| <= 2^B; every operator returns the width
// its result needs, so an expression whose type fits its storage cannot overflow, and one that does not fit does not
// compile.
//
// Widths: |x| <= 2^A and |y| <= 2^C give |x + y|, |x - y| <= 2^(max(A, C) + 1), |x y| <= 2^(A + C), |-x| <= 2^A,
// |x 2^K| <= 2^(A + K). The bound is inclusive, which is what makes the product rule tight.
// Storage: std::int64_t up to B = 62, __int128 up to B = 126, then two's complement limbs.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <compare>
#include <cstdint>
#include <type_traits>

#include "base/bit_cast.h"
#include "exact/limbs.h"

namespace dymsum::exact {

/// Limbs that hold all v with |v| <= 2^B: the magnitude needs B + 1 bits, the sign one more.
constexpr int limb_count(int bits) { return (bits + 2 + 63) / 64; }
static_assert(limb_count(62) == 1 && limb_count(63) == 2 && limb_count(126) == 2 && limb_count(127) == 3);

template <int B>
using IntRaw = std::conditional_t<(B <= 62), std::int64_t, std::conditional_t<(B <= 126), i128, Limbs<limb_count(B)>>>;

/// The raw value of one width as the raw value of another: exact when the target is at least as wide, else modulo its
/// size.
template <int To, class Raw>
constexpr IntRaw<To> raw_cast(const Raw& v) {
  if constexpr (std::is_same_v<IntRaw<To>, Raw>) {
    return v;
  } else if constexpr (To <= 126) {
    static_assert(std::is_arithmetic_v<Raw> || std::is_same_v<Raw, i128>);
    return static_cast<IntRaw<To>>(v);
  } else {
    return limbs_cast<limb_count(To)>(to_limbs(v));
  }
}

template <int B>
class Int {
  static_assert(B >= 0);

 public:
  static constexpr int kBits = B;
  using Raw = IntRaw<B>;

  constexpr Int() = default;

  /// Widening. The converse does not compile.
  template <int A>
  requires(A < B) constexpr Int(const Int<A>& narrower) : raw_(raw_cast<B>(narrower.raw())) {}

  /// Requires |v| <= 2^B, asserted in debug builds.
  static constexpr Int from_int64(std::int64_t v) {
    if constexpr (B < 62) assert(v <= (std::int64_t{1} << B) && v >= -(std::int64_t{1} << B));
    if constexpr (B == 62) assert(in_bound(v));
    return Int(raw_cast<B>(v));
  }
  /// m * 2^shift - n * 2^other_shift. Only the difference has to be within the bound: the terms wrap around.
  static constexpr Int from_dyadic_difference(std::int64_t m, int shift, std::int64_t n, int other_shift) {
    const Raw a = shifted_raw(m, shift), b = shifted_raw(n, other_shift);
    if constexpr (B <= 62) {
      return from_raw(static_cast<Raw>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b)));
    } else if constexpr (B <= 126) {
      return from_raw(static_cast<Raw>(static_cast<u128>(a) - static_cast<u128>(b)));
    } else {
      return from_raw(limbs_sub(a, b));
    }
  }
  /// m * 2^shift modulo the storage, shift >= 0.
  static constexpr Raw shifted_raw(std::int64_t m, int shift) {
    if constexpr (B <= 62) {
      return shift < 64 ? static_cast<Raw>(static_cast<std::uint64_t>(m) << shift) : 0;
    } else if constexpr (B <= 126) {
      return shift < 128 ? static_cast<Raw>(static_cast<u128>(static_cast<i128>(m)) << shift) : 0;
    } else {
      return limbs_shift_left(raw_cast<B>(m), shift);
    }
  }
  /// Requires that the value is within the bound, asserted in debug builds.
  static constexpr Int from_raw(const Raw& raw) {
    assert(in_bound(raw));
    return Int(raw);
  }
  /// The largest value, 2^B.
  static constexpr Int max() { return Int(shifted_raw(1, B)); }

  constexpr const Raw& raw() const { return raw_; }

  static constexpr bool in_bound(const Raw& v) {
    const Raw limit = shifted_raw(1, B);
    if constexpr (B <= 126) {
      return v <= limit && v >= -limit;
    } else {
      return limbs_compare(v, limit) <= 0 && limbs_compare(v, limbs_sub(Raw{}, limit)) >= 0;
    }
  }

 private:
  constexpr explicit Int(const Raw& raw) : raw_(raw) {}
  Raw raw_{};
};

template <int A, int C>
constexpr Int<std::max(A, C) + 1> operator+(const Int<A>& a, const Int<C>& b) {
  constexpr int R = std::max(A, C) + 1;
  if constexpr (R <= 126) {
    return Int<R>::from_raw(raw_cast<R>(a.raw()) + raw_cast<R>(b.raw()));
  } else {
    return Int<R>::from_raw(limbs_add(raw_cast<R>(a.raw()), raw_cast<R>(b.raw())));
  }
}

template <int A, int C>
constexpr Int<std::max(A, C) + 1> operator-(const Int<A>& a, const Int<C>& b) {
  constexpr int R = std::max(A, C) + 1;
  if constexpr (R <= 126) {
    return Int<R>::from_raw(raw_cast<R>(a.raw()) - raw_cast<R>(b.raw()));
  } else {
    return Int<R>::from_raw(limbs_sub(raw_cast<R>(a.raw()), raw_cast<R>(b.raw())));
  }
}

template <int B>
constexpr Int<B> operator-(const Int<B>& a) {
  if constexpr (B <= 126) {
    return Int<B>::from_raw(-a.raw());
  } else {
    return Int<B>::from_raw(limbs_sub(typename Int<B>::Raw{}, a.raw()));
  }
}

template <int A, int C>
constexpr Int<A + C> operator*(const Int<A>& a, const Int<C>& b) {
  constexpr int R = A + C;
  if constexpr (R <= 126) {
    return Int<R>::from_raw(raw_cast<R>(a.raw()) * raw_cast<R>(b.raw()));
  } else {
    return Int<R>::from_raw(limbs_multiply<limb_count(R)>(to_limbs(a.raw()), to_limbs(b.raw())));
  }
}

template <int A, int C>
constexpr bool operator==(const Int<A>& a, const Int<C>& b) {
  constexpr int W = std::max(A, C);
  return raw_cast<W>(a.raw()) == raw_cast<W>(b.raw());
}

template <int A, int C>
constexpr std::strong_ordering operator<=>(const Int<A>& a, const Int<C>& b) {
  constexpr int W = std::max(A, C);
  if constexpr (W <= 126) {
    return raw_cast<W>(a.raw()) <=> raw_cast<W>(b.raw());
  } else {
    return limbs_compare(raw_cast<W>(a.raw()), raw_cast<W>(b.raw()));
  }
}

/// -1, 0 or 1.
template <int B>
constexpr int sign(const Int<B>& a) {
  if constexpr (B <= 126) {
    return (a.raw() > 0) - (a.raw() < 0);
  } else {
    std::uint64_t any = 0;
    for (const std::uint64_t limb : a.raw().w) any |= limb;
    return a.raw().negative() ? -1 : any != 0;
  }
}

/// |a|.
template <int B>
constexpr Int<B> abs(const Int<B>& a) {
  return sign(a) < 0 ? -a : a;
}

/// |a| <= 2^C.
template <int C, int B>
constexpr bool fits(const Int<B>& a) {
  return a <= Int<C>::max() && a >= -Int<C>::max();
}

/// a * 2^K.
template <int K, int B>
constexpr Int<B + K> shift_left(const Int<B>& a) {
  static_assert(K >= 0);
  constexpr int R = B + K;
  if constexpr (R <= 126) {
    return Int<R>::from_raw(raw_cast<R>(a.raw()) << K);
  } else {
    return Int<R>::from_raw(limbs_shift_left(raw_cast<R>(a.raw()), K));
  }
}

/// 2^e for -1022 <= e <= 1023.
constexpr double power_of_two(int e) { return base::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52); }

/// The double nearest to a non-negative integer: its 64 leading bits with a sticky lowest bit are rounded once,
/// correctly, and scaling by a power of two is exact or overflows to infinity.
template <int N>
double limbs_to_double(const Limbs<N>& magnitude) {
  int top = N - 1;
  while (top > 0 && magnitude.w[top] == 0) --top;
  if (top == 0) return static_cast<double>(magnitude.w[0]);
  const int zeros = std::countl_zero(magnitude.w[top]);
  const std::uint64_t below = magnitude.w[top - 1];
  std::uint64_t leading = magnitude.w[top] << zeros;
  std::uint64_t rest = below << zeros;
  if (zeros != 0) leading |= below >> (64 - zeros);
  for (int i = 0; i + 1 < top; ++i) rest |= magnitude.w[i];
  const double rounded = static_cast<double>(leading | (rest != 0));
  if constexpr (64 * N <= 1023) return rounded * power_of_two(64 * top - zeros);
  return std::ldexp(rounded, 64 * top - zeros);
}

/// The value with relative error at most 2^-52, exact when it has at most 53 significant bits; infinite past the double
/// range.
///
/// Two limbs: v = h 2^64 + l with l in [-2^63, 2^63); h, l and the sum are rounded, with u = 2^-53.
/// Where |h| <= 2^53, h is exact, rounding l errs by at most 2^9 <= 2^-54 |v| when h != 0 (then |v| >= 2^63) and the
/// sum by u: below 2u. Where |h| > 2^53, h errs by u / (1 + u) and the sum by as much, together 2u - u^2 at most up to
/// terms in u^3, and rounding l errs by 2^9 < 2^-108 |v| < u^2 |v| / 2: below 2u = 2^-52.
template <int B>
double to_double(const Int<B>& a) {
  if constexpr (B <= 62) {
    return static_cast<double>(a.raw());
  } else if constexpr (B <= 126) {
    const auto low = static_cast<std::int64_t>(static_cast<std::uint64_t>(a.raw()));
    const auto high = static_cast<std::int64_t>(a.raw() >> 64) + (low < 0);
    return static_cast<double>(high) * 0x1p64 + static_cast<double>(low);
  } else {
    return sign(a) < 0 ? -limbs_to_double((-a).raw()) : limbs_to_double(a.raw());
  }
}

}  // namespace dymsum::exact
