// The lossless grid. Finite doubles are integers times a power of two; all coordinates of a problem share the largest
// unit 2^exponent that divides every one of them, and are integers of proved width on that grid. The width picks the
// number tier.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>

#include "dymsum/region.h"
#include "exact/int.h"

namespace dymsum::exact {

/// v = mantissa * 2^exponent with odd mantissa; {0, 0} for zero. Requires v finite.
struct Dyadic {
  std::int64_t mantissa = 0;
  int exponent = 0;
};
Dyadic to_dyadic(double v);

/// The largest k such that every value is an integer multiple of 2^k; 0 if all are zero. Requires finite values.
/// -1074 <= k <= 1023. O(n).
int common_exponent(std::span<const double> values);

/// The same for the coordinates of points.
int common_exponent(std::span<const Point> points);

/// The same for the values of both spans together.
int common_exponent(std::span<const double> xs, std::span<const double> ys);

/// The smallest B >= 0 with max_abs <= 2^B 2^exponent. Requires max_abs >= 0 and finite.
int bits_needed(double max_abs, int exponent);

/// The smallest B >= 0 with |v - offset| <= 2^B 2^exponent for all v between low and high, exactly, although the
/// differences may not be doubles. Requires finite values.
int bits_needed(double low, double high, double offset, int exponent);

/// A multiple of 2^exponent that is a double, at most one unit or one ulp from the midpoint of [low, high]: the offset
/// that leaves the narrowest coordinates. Requires low <= high, finite, multiples of 2^exponent.
double grid_center(double low, double high, int exponent);

/// A number tier, named by the SumOptions::min_tier_bits value that requests it. Coordinates X are bounded by 2^B with
/// B = 29, 61, 125 and unbounded. The widest sign of the hot path is the order of two crossings on one segment,
///   edge       p2 - p1                  |.| <= 2^(B+1)
///   sum        p + q                            2^(B+1)
///   gap        (p + q) - (p' + q')              2^(B+2)
///   D          edge x edge                      2^(2B+3)
///   N          gap x edge                       2^(2B+4)
///   order      N1 D2 - N2 D1                    2^(4B+8)
/// which is 124, 252 and 508 bits: one __int128, four limbs, eight limbs. The static_asserts below check the types.
enum class Tier { b29 = 29, b61 = 61, b512 = 512, arbitrary = 0 };

/// The bound B of a tier's coordinates; -1 for arbitrary.
constexpr int coordinate_bits(Tier tier) {
  return tier == Tier::b29 ? 29 : tier == Tier::b61 ? 61 : tier == Tier::b512 ? 125 : -1;
}

/// The narrowest tier whose coordinates hold `bits` bits and that is at least min_tier_bits (29, 61, 512; above:
/// arbitrary).
constexpr Tier choose_tier(int bits, int min_tier_bits) {
  if (bits <= coordinate_bits(Tier::b29) && min_tier_bits <= 29) return Tier::b29;
  if (bits <= coordinate_bits(Tier::b61) && min_tier_bits <= 61) return Tier::b61;
  if (bits <= coordinate_bits(Tier::b512) && min_tier_bits <= 512) return Tier::b512;
  return Tier::arbitrary;
}

/// (v - offset) / 2^exponent as a C, an Int<B> or Big. Requires that v and offset are multiples of 2^exponent and
/// |v - offset| <= 2^B 2^exponent (asserted in debug builds as far as the storage shows it).
template <class C>
C grid_coordinate(double v, double offset, int exponent) {
  const Dyadic a = to_dyadic(v), b = to_dyadic(offset);
  const int shift_a = a.mantissa == 0 ? 0 : a.exponent - exponent;
  const int shift_b = b.mantissa == 0 ? 0 : b.exponent - exponent;
  assert(shift_a >= 0 && shift_b >= 0);
  return C::from_dyadic_difference(a.mantissa, shift_a, b.mantissa, shift_b);
}

/// v / 2^exponent.
template <class C>
C grid_coordinate(double v, int exponent) {
  return grid_coordinate<C>(v, 0.0, exponent);
}

/// The types of the table above for coordinates Int<B>.
template <int B>
struct PlanarWidths {
  using Coordinate = Int<B>;
  using Edge = decltype(Coordinate{} - Coordinate{});
  using Sum = decltype(Coordinate{} + Coordinate{});
  using Gap = decltype(Sum{} - Sum{});
  using D = decltype(Edge{} * Edge{} - Edge{} * Edge{});
  using N = decltype(Gap{} * Edge{} - Gap{} * Edge{});
  using Order = decltype(N{} * D{} - N{} * D{});
  static_assert(Edge::kBits == B + 1 && Sum::kBits == B + 1 && Gap::kBits == B + 2);
  static_assert(D::kBits == 2 * B + 3 && N::kBits == 2 * B + 4 && Order::kBits == 4 * B + 8);
};
static_assert(PlanarWidths<29>::N::kBits == 62 && sizeof(PlanarWidths<29>::N) == 8);
static_assert(PlanarWidths<29>::Order::kBits == 124 && sizeof(PlanarWidths<29>::Order) == 16);
static_assert(PlanarWidths<61>::N::kBits == 126 && sizeof(PlanarWidths<61>::N) == 16);
static_assert(PlanarWidths<61>::Order::kBits == 252 && sizeof(PlanarWidths<61>::Order) == 32);
static_assert(PlanarWidths<125>::N::kBits == 254 && sizeof(PlanarWidths<125>::N) == 32);
static_assert(PlanarWidths<125>::Order::kBits == 508 && sizeof(PlanarWidths<125>::Order) == 64);

}  // namespace dymsum::exact
