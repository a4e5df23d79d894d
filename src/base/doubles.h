// Doubles: their bits, two in a register, pairs of them with nearly twice the digits, lengths, and what is left of one
// in single precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

#ifdef __SSE2__
#include <emmintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace dymsum::base {

// Doubles: their bits, pairs of them with nearly twice the digits, lengths, and what is left of one in single
// precision.

// std::bit_cast, which the standard library of Debian 12's emscripten lacks.

template <class To, class From>
constexpr To bit_cast(const From& from) {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
  return __builtin_bit_cast(To, from);
}

// The length of a vector in space.

/// The length std::hypot(x, y, z), which some standard libraries compute without care for overflow, and each with
/// roundings of its own: here the same everywhere.
inline double hypot3(double x, double y, double z) {
  const double most = std::max({std::abs(x), std::abs(y), std::abs(z)});
  if (!(most > 0)) return 0;
  return most * std::sqrt((x / most) * (x / most) + (y / most) * (y / most) + (z / most) * (z / most));
}

// Single precision, as doubles.

/// The nearest number of single precision, infinite past its range. The step through memory is there for GCC 12: with
/// -O3 it leaves out the conversion to single precision and back where it takes two coordinates at a time.
inline double in_single(double value) {
  const volatile float nearest = static_cast<float>(value);
  return nearest;
}

// Numbers as unevaluated sums of two doubles, about thirty digits: where doubles alone lose too much and exact integers
// cost too much.
//
// The operators keep |low| <= ulp(high) / 2 and have a relative error below 2^-100, as long as nothing overflows and no
// error term underflows. With u = 2^-53 the sum errs by at most 3 u^2 / (1 - 4 u) and the product by 7 u^2 (Joldes,
// Muller, Popescu 2017, algorithms 6 and 10); the two remainders of a quotient err by 11 u^2 of it, and adding its
// parts by 3 u^2.

/// The error of an operation, times its result.
inline constexpr double kPairError = 0x1p-100;

struct DoublePair {
  double high = 0, low = 0;
  double value() const { return high + low; }
};

inline DoublePair exact_sum(double a, double b) {
  const double s = a + b, t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}
#ifdef __EMSCRIPTEN__
/// a b - p for p = a * b by halves of 26 bits (Veltkamp, Dekker 1971): WebAssembly has no fma, and its C library's
/// takes fifty times as long. Where halves may overflow, or rests underflow, that one is taken.
inline double rest_of_product(double a, double b, double p) {
  constexpr double kSplit = 0x1p27 + 1, kHuge = 0x1p990, kTiny = 0x1p-900;
  if (a == 0 || b == 0) return 0;
  if (!(std::fabs(a) < kHuge && std::fabs(b) < kHuge && std::fabs(p) > kTiny)) return std::fma(a, b, -p);
  const double ta = kSplit * a, tb = kSplit * b;
  const double a1 = ta - (ta - a), a2 = a - a1, b1 = tb - (tb - b), b2 = b - b1;
  return ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2;
}
#else
inline double rest_of_product(double a, double b, double p) { return std::fma(a, b, -p); }
#endif
inline DoublePair exact_product(double a, double b) {
  const double p = a * b;
  return {p, rest_of_product(a, b, p)};
}
inline DoublePair operator-(DoublePair a) { return {-a.high, -a.low}; }
inline DoublePair operator+(DoublePair a, DoublePair b) {
  const DoublePair s = exact_sum(a.high, b.high), t = exact_sum(a.low, b.low);
  const DoublePair u = exact_sum(s.high, s.low + t.high);
  return exact_sum(u.high, u.low + t.low);
}
inline DoublePair operator-(DoublePair a, DoublePair b) { return a + -b; }
inline DoublePair operator*(DoublePair a, DoublePair b) {
  const DoublePair p = exact_product(a.high, b.high);
  return exact_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}
/// Requires b to be different from zero.
inline DoublePair operator/(DoublePair a, DoublePair b) {
  const double q = a.high / b.high;
  const DoublePair rest = a - b * DoublePair{q, 0};
  const double r = rest.high / b.high;
  const DoublePair left = rest - b * DoublePair{r, 0};
  return exact_sum(q, r) + DoublePair{left.high / b.high, 0};
}
/// Requires a > 0.
inline DoublePair square_root(DoublePair a) {
  const double x = std::sqrt(a.high);
  const DoublePair rest = a - exact_product(x, x);
  return exact_sum(x, rest.high / (2 * x));
}

}  // namespace dymsum::base

namespace dymsum {

// Two doubles at a time: x and y of a point, or what is asked of the first of two segments against the second one and
// of the second against the first. The same operations as on doubles, one rounding each.

using Two = double __attribute__((vector_size(16)));
/// What comparing gives: -1 or 0 in each.
using TwoDecided = std::int64_t __attribute__((vector_size(16)));

inline Two both(double v) { return Two{v, v}; }
inline Two firsts(Two a, Two b) { return __builtin_shufflevector(a, b, 0, 2); }
inline Two seconds(Two a, Two b) { return __builtin_shufflevector(a, b, 1, 3); }
inline Two exchanged(Two a) { return __builtin_shufflevector(a, a, 1, 0); }
inline Two least(Two a, Two b) { return a < b ? a : b; }
inline Two most(Two a, Two b) { return a > b ? a : b; }
inline Two magnitude(Two a) { return most(a, -a); }

inline bool any(TwoDecided decided) {
#ifdef __SSE2__
  return _mm_movemask_pd(reinterpret_cast<__m128d>(decided)) != 0;
#elif defined(__wasm_simd128__)
  return wasm_v128_any_true(reinterpret_cast<v128_t>(decided));
#else
  return (decided[0] | decided[1]) != 0;
#endif
}

/// Whether it holds in both lanes; false where something is not a number.
inline bool every(TwoDecided decided) {
#ifdef __SSE2__
  return _mm_movemask_pd(reinterpret_cast<__m128d>(decided)) == 3;
#elif defined(__wasm_simd128__)
  return wasm_i64x2_all_true(reinterpret_cast<v128_t>(decided));
#else
  return (decided[0] & decided[1]) != 0;
#endif
}

}  // namespace dymsum
