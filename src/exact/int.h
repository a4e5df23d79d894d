// Integers of fixed width whose operators compute the width of their result: limbs, signs of products, vectors.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "base/doubles.h"

namespace dymsum::exact {

// Integers whose type proves their size. Int<B> holds any integer v with |v| <= 2^B; every operator returns the width
// its result needs, so an expression whose type fits its storage cannot overflow, and one that does not fit does not
// compile.
//
// Widths: |x| <= 2^A and |y| <= 2^C give |x + y|, |x - y| <= 2^(max(A, C) + 1), |x y| <= 2^(A + C), |-x| <= 2^A,
// |x 2^K| <= 2^(A + K). The bound is inclusive, which is what makes the product rule tight.
// Storage: std::int64_t up to B = 62, __int128 up to B = 126, then two's complement limbs.

// Two's complement integers of a fixed number of 64-bit limbs, least significant first: the storage of exact::Int past
// 126 bits. All operations are modulo 2^(64 N); exact::Int proves that nothing is lost.

__extension__ typedef __int128 i128;
__extension__ typedef unsigned __int128 u128;

template <int N>
struct Limbs {
  static_assert(N >= 1);
  std::array<std::uint64_t, N> w{};

  constexpr bool negative() const { return static_cast<std::int64_t>(w[N - 1]) < 0; }
  friend constexpr bool operator==(const Limbs&, const Limbs&) = default;
};

/// Sign extension (N >= M) or reduction modulo 2^(64 N) (N < M).
template <int N, int M>
constexpr Limbs<N> limbs_cast(const Limbs<M>& a) {
  if constexpr (N == M) {
    return a;
  } else {
    Limbs<N> r;
    const std::uint64_t fill = a.negative() ? ~std::uint64_t{0} : 0;
    for (int i = 0; i < N; ++i) r.w[i] = i < M ? a.w[i] : fill;
    return r;
  }
}

constexpr Limbs<1> to_limbs(std::int64_t v) { return {{static_cast<std::uint64_t>(v)}}; }
constexpr Limbs<2> to_limbs(i128 v) { return {{static_cast<std::uint64_t>(v), static_cast<std::uint64_t>(v >> 64)}}; }
template <int N>
constexpr const Limbs<N>& to_limbs(const Limbs<N>& v) {
  return v;
}

template <int N>
constexpr Limbs<N> limbs_add(const Limbs<N>& a, const Limbs<N>& b) {
  Limbs<N> r;
  std::uint64_t carry = 0;
  for (int i = 0; i < N; ++i) {
    const u128 s = static_cast<u128>(a.w[i]) + b.w[i] + carry;
    r.w[i] = static_cast<std::uint64_t>(s);
    carry = static_cast<std::uint64_t>(s >> 64);
  }
  return r;
}

template <int N>
constexpr Limbs<N> limbs_sub(const Limbs<N>& a, const Limbs<N>& b) {
  Limbs<N> r;
  std::uint64_t borrow = 0;
  for (int i = 0; i < N; ++i) {
    const u128 s = static_cast<u128>(a.w[i]) - b.w[i] - borrow;
    r.w[i] = static_cast<std::uint64_t>(s);
    borrow = static_cast<std::uint64_t>(s >> 64) & 1;
  }
  return r;
}

template <int N>
constexpr std::strong_ordering limbs_compare(const Limbs<N>& a, const Limbs<N>& b) {
  const auto high_a = static_cast<std::int64_t>(a.w[N - 1]), high_b = static_cast<std::int64_t>(b.w[N - 1]);
  if (high_a != high_b) return high_a <=> high_b;
  for (int i = N - 2; i >= 0; --i)
    if (a.w[i] != b.w[i]) return a.w[i] <=> b.w[i];
  return std::strong_ordering::equal;
}

/// The low R limbs of the unsigned product; R <= N + M.
template <int R, int N, int M>
constexpr Limbs<R> limbs_multiply_unsigned(const Limbs<N>& a, const Limbs<M>& b) {
  Limbs<R> r;
  for (int i = 0; i < N && i < R; ++i) {
    std::uint64_t carry = 0;
    for (int j = 0; j < M && i + j < R; ++j) {
      const u128 t = static_cast<u128>(a.w[i]) * b.w[j] + r.w[i + j] + carry;  // <= 2^128 - 1
      r.w[i + j] = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64);
    }
    if (i + M < R) r.w[i + M] = carry;
  }
  return r;
}

/// The same for two limbs each, the product of two __int128, written out because the crossing order of the 61-bit tier
/// lives on it: four multiplications, carries without loops.
constexpr Limbs<4> limbs_multiply_unsigned_2x2(const Limbs<2>& a, const Limbs<2>& b) {
  const u128 low = static_cast<u128>(a.w[0]) * b.w[0], high = static_cast<u128>(a.w[1]) * b.w[1];
  const u128 cross1 = static_cast<u128>(a.w[0]) * b.w[1], cross2 = static_cast<u128>(a.w[1]) * b.w[0];
  const u128 midpoint = cross1 + static_cast<std::uint64_t>(low >> 64);  // <= (2^64-1)^2 + 2^64-1 < 2^128
  const u128 middle2 = cross2 + static_cast<std::uint64_t>(midpoint);
  const u128 top = high + static_cast<std::uint64_t>(midpoint >> 64) + static_cast<std::uint64_t>(middle2 >> 64);
  return {{static_cast<std::uint64_t>(low), static_cast<std::uint64_t>(middle2), static_cast<std::uint64_t>(top),
           static_cast<std::uint64_t>(top >> 64)}};
}

/// a -= 2^(64 At) * (negative ? b : 0), modulo 2^(64 R), without a branch.
template <int At, int R, int M>
constexpr void limbs_subtract_if(Limbs<R>& a, bool negative, const Limbs<M>& b) {
  const std::uint64_t mask = negative ? ~std::uint64_t{0} : 0;
  std::uint64_t borrow = 0;
  for (int i = At; i < R; ++i) {
    const std::uint64_t limb = i - At < M ? b.w[i - At] & mask : 0;
    const u128 s = static_cast<u128>(a.w[i]) - limb - borrow;
    a.w[i] = static_cast<std::uint64_t>(s);
    borrow = static_cast<std::uint64_t>(s >> 64) & 1;
  }
}

/// The signed product modulo 2^(64 R), R <= N + M: with a = ua - 2^(64 N) [a < 0] and b alike, the signed product is
/// the unsigned one less 2^(64 N) ub [a < 0] and 2^(64 M) ua [b < 0]; the fourth term is a multiple of 2^(64 (N + M)).
template <int R, int N, int M>
constexpr Limbs<R> limbs_multiply(const Limbs<N>& a, const Limbs<M>& b) {
  static_assert(R <= N + M);
  Limbs<R> r;
  if constexpr (N == 2 && M == 2 && R == 4) {
    r = limbs_multiply_unsigned_2x2(a, b);
  } else {
    r = limbs_multiply_unsigned<R>(a, b);
  }
  limbs_subtract_if<N>(r, a.negative(), b);
  limbs_subtract_if<M>(r, b.negative(), a);
  return r;
}

/// a * 2^shift modulo 2^(64 N), shift >= 0.
template <int N>
constexpr Limbs<N> limbs_shift_left(const Limbs<N>& a, int shift) {
  Limbs<N> r;
  const int whole = shift / 64, part = shift % 64;
  for (int i = N - 1; i >= whole; --i) {
    r.w[i] = a.w[i - whole] << part;
    if (part != 0 && i > whole) r.w[i] |= a.w[i - whole - 1] >> (64 - part);
  }
  return r;
}

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

// Signs of small polynomials over exact integers, generic in the number type (Int of any widths, mixed, or Big). Exact
// by construction: the intermediate types are as wide as the values can be.

/// sign(ax by - ay bx): > 0 when b points to the left of a.
template <class Ax, class Ay, class Bx, class By>
constexpr int sign_of_cross(const Ax& ax, const Ay& ay, const Bx& bx, const By& by) {
  return sign(ax * by - ay * bx);
}

/// sign(ax bx + ay by).
template <class Ax, class Ay, class Bx, class By>
constexpr int sign_of_dot(const Ax& ax, const Ay& ay, const Bx& bx, const By& by) {
  return sign(ax * bx + ay * by);
}

/// sign(n1 / d1 - n2 / d2) for d1, d2 != 0 of any sign.
template <class N1, class D1, class N2, class D2>
constexpr int compare_ratios(const N1& n1, const D1& d1, const N2& n2, const D2& d2) {
  return sign(n1 * d2 - n2 * d1) * sign(d1) * sign(d2);
}

/// -1, 0, 1 for a < b, a == b, a > b, without widening.
template <class A, class B>
constexpr int compare(const A& a, const B& b) {
  return (a > b) - (a < b);
}

// Vectors of three exact integers (Int of any widths, or Big): the result types are as wide as the values can be.

template <class T>
struct Vector3 {
  T x{}, y{}, z{};
};

template <class A, class B>
auto operator-(const Vector3<A>& a, const Vector3<B>& b) {
  return Vector3<decltype(a.x - b.x)>{a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class A, class B>
auto operator+(const Vector3<A>& a, const Vector3<B>& b) {
  return Vector3<decltype(a.x + b.x)>{a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class A, class B>
auto dot(const Vector3<A>& a, const Vector3<B>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class A, class B>
auto cross(const Vector3<A>& a, const Vector3<B>& b) {
  using R = decltype(a.y * b.z - a.z * b.y);
  return Vector3<R>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Three rows.
template <class T>
using Matrix3 = std::array<Vector3<T>, 3>;

/// m v.
template <class M, class T>
auto apply(const Matrix3<M>& m, const Vector3<T>& v) {
  using R = decltype(dot(m[0], v));
  return Vector3<R>{dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}
template <class M>
Matrix3<M> transposed(const Matrix3<M>& m) {
  return {Vector3<M>{m[0].x, m[1].x, m[2].x}, Vector3<M>{m[0].y, m[1].y, m[2].y}, Vector3<M>{m[0].z, m[1].z, m[2].z}};
}

/// The sign of the first component that is not zero; 0 for the zero vector.
template <class T>
int leading_sign(const Vector3<T>& v) {
  if (const int s = sign(v.x)) return s;
  if (const int s = sign(v.y)) return s;
  return sign(v.z);
}

/// The budgets of exact-integer geometry in space, for coordinates |X| <= 2^B: edges, normals of faces, sides of
/// planes.
template <int B>
struct SpatialWidths {
  using Coordinate = Int<B>;
  using Edge = decltype(Coordinate{} - Coordinate{});
  using Normal = decltype(Edge{} * Edge{} - Edge{} * Edge{});
  using Side = decltype(Normal{} * Edge{} + Normal{} * Edge{} + Normal{} * Edge{});
  static_assert(Edge::kBits == B + 1 && Normal::kBits == 2 * B + 3 && Side::kBits == 3 * B + 6);
};
static_assert(sizeof(SpatialWidths<26>::Normal) == 8 && sizeof(SpatialWidths<26>::Side) == 16);
static_assert(sizeof(SpatialWidths<61>::Normal) == 16 && sizeof(SpatialWidths<61>::Side) == 24);

}  // namespace dymsum::exact
