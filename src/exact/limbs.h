// Two's complement integers of a fixed number of 64-bit limbs, least significant first: the storage of exact::Int past
// 126 bits. All operations are modulo 2^(64 N); exact::Int proves that nothing is lost.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

namespace dymsum::exact {

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

}  // namespace dymsum::exact
