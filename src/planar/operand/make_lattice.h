// What lattices of all kinds are built with: points in units, bits, tiers.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "base/doubles.h"
#include "exact/grid.h"
#include "planar/operand/lattice.h"

namespace dymsum::planar {

/// x and y of points in units of 2^unit.
void position_in_units(PlacedPoints& points, int unit);

/// The smallest k for which an extent and its ulp are at most 2^k.
int top_of(double extent);

/// Grid units while these fit well, else 2^-60 of the extent, so that nothing overflows.
int unit_for(double extent, int exponent, int bits);

/// 2^k.
inline double power_of_two(int k) {
  if (k < -1022 || k > 1023) return std::ldexp(1.0, k);
  return base::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

/// The smallest k with n <= 2^k, for n > 0.
inline int factor_bits(const exact::BigInteger& n) {
  const int top = static_cast<int>(msb(n));
  return (n & (n - 1)) == 0 ? top : top + 1;
}

/// The origin of a rotated operand's integers in input coordinates, rounded.
Point turned_offset(const PlacedPoints& points, const LatticeScale& rotation, int grid_exponent);

/// The points of both operands in units of 2^unit, on a common grid, with coordinates of at most `bits` bits.
struct LatticePoints {
  std::array<std::shared_ptr<const PlacedPoints>, 2> points;
  int grid_exponent = 0, unit = 0, bits = 0;
  std::shared_ptr<SharedIntegers> integers;  ///< see LatticeDoubles
};
/// How many integers make a unit of the doubles, where these are exact; else 0.
double integers_per_double(const LatticePoints& points, const std::optional<LatticeScale>& scale);
/// All but the tier.
LatticeDoubles lattice_doubles(const LatticePoints& points, const std::optional<LatticeScale>& scale);
std::shared_ptr<const Lattice> build_lattice(LatticePoints points, std::optional<LatticeScale> scale,
                                             int min_tier_bits);

}  // namespace dymsum::planar
