// The lattice that operands get: the grid that holds both, the unit of the doubles, and what is determined in doubles.
#include <algorithm>
#include <cmath>

#include "exact/rounding_bound.h"
#include "planar/operand/fraction_points.h"
#include "planar/operand/lattice_build.h"

namespace dymsum::planar {

using exact::BigRational;

namespace {

// The error of a scaled offset.
constexpr double kScaledBase = exact::rounding_bound(2, 4);

// The sum of both offsets in input coordinates, and how it errs.
void add_offsets(LatticeDoubles& lattice, const std::optional<LatticeScale>& scale) {
  for (std::uint32_t op = 0; op < 2; ++op) {
    const PlacedPoints& o = *lattice.points[op];
    const bool scaled = scale && op == scale->op;
    const Point at = scaled && o.turned != nullptr ? turned_offset(o, *scale, lattice.grid_exponent)
                                                   : Point{o.offset.x * o.factors.x, o.offset.y * o.factors.y};
    lattice.base.x += at.x;
    lattice.base.y += at.y;
    lattice.base_reach += std::abs(at.x) + std::abs(at.y);
    // The factor and the product are rounded.
    if (scaled) lattice.base_error = kScaledBase * (std::abs(at.x) + std::abs(at.y));
  }
}

bool is_dyadic(const std::optional<LatticeScale>& scale) { return !scale || (scale->den & (scale->den - 1)) == 0; }

}  // namespace

// Integers are doubles over a power of two where the scale's denominator is one: with at most 53 bits, no step of
// making them was rounded.
double integers_per_double(const LatticePoints& points, const std::optional<LatticeScale>& scale) {
  const bool dyadic = is_dyadic(scale), turned = scale && points.points[scale->op]->turned != nullptr;
  const int shift = points.unit - points.grid_exponent + (scale && dyadic ? static_cast<int>(msb(scale->den)) : 0);
  return points.bits <= 53 && dyadic && !turned && std::abs(shift) <= 1000 ? power_of_two(shift) : 0;
}

LatticeDoubles lattice_doubles(const LatticePoints& points, const std::optional<LatticeScale>& scale) {
  const int exponent = points.grid_exponent;
  const double den = scale ? exact::round_to_double(BigRational(scale->den)) : 1;
  LatticeDoubles doubles;
  // Sides have at most 2 B + 4 bits; doubles hold 53. A power of two below scaled coordinates changes nothing.
  doubles.exact_doubles = points.bits <= 24 && is_dyadic(scale);
  doubles.points = points.points;
  doubles.integers = points.integers;
  doubles.unit = power_of_two(points.unit);
  doubles.grid_exponent = exponent;
  doubles.integers_per_unit = den == 1 ? power_of_two(points.unit - exponent) : std::ldexp(den, points.unit - exponent);
  if (scale) {
    const int shift = static_cast<int>(msb(scale->den));
    doubles.mantissa = exact::round_to_double(BigRational(scale->den, exact::BigInteger(1) << shift));
    doubles.integer_exponent = shift;
  }
  doubles.integer_exponent += points.unit - exponent;
  for (const auto& o : points.points) doubles.wide |= o->bits(exponent) > kNarrowBits;
  for (const auto& o : points.points) doubles.span += std::max(o->width, o->height);
  add_offsets(doubles, scale);
  doubles.exact_input = doubles.exact_doubles && !scale &&
                        doubles.span * doubles.unit + doubles.base_reach <= power_of_two(std::min(exponent + 50, 1000));
  return doubles;
}

std::shared_ptr<const Lattice> make_lattice(std::shared_ptr<const PlacedPoints> p,
                                            std::shared_ptr<const PlacedPoints> q, int min_tier_bits, Further further) {
  std::array<std::shared_ptr<const PlacedPoints>, 2> points{std::move(p), std::move(q)};
  // All-zero coordinates are on every grid.
  const auto no_grid = [](const PlacedPoints& o) { return o.extent == 0 && o.offset == Point{}; };
  const bool fractions = points[0]->fractions != nullptr || points[1]->fractions != nullptr;
  const int exponent = no_grid(*points[0])   ? points[1]->exponent
                       : no_grid(*points[1]) ? points[0]->exponent
                                             : std::min(points[0]->exponent, points[1]->exponent);
  const int bits = std::max(points[0]->bits(exponent), points[1]->bits(exponent));
  const int unit = points[0]->moderate() && points[1]->moderate()
                       ? 0
                       : unit_for(std::max(points[0]->extent, points[1]->extent), exponent, bits);
  for (auto& o : points) {
    if (o->unit == unit) continue;
    auto moved = std::make_shared<PlacedPoints>(*o);
    position_in_units(*moved, unit);
    o = std::move(moved);
  }
  if (fractions) return make_fraction_lattice({std::move(points), exponent, unit, bits, nullptr});
  return build_lattice({std::move(points), exponent, unit, bits,
                        further == Further::lattices ? std::make_shared<SharedIntegers>() : nullptr},
                       std::nullopt, min_tier_bits);
}

namespace {

// num / den for positive integers, rounded once: where both are doubles, their division is.
double quotient(const exact::BigInteger& num, const exact::BigInteger& den) {
  if (msb(num) >= 53 || msb(den) >= 53) return exact::round_to_double(BigRational(num, den));
  return static_cast<double>(static_cast<std::uint64_t>(num)) / static_cast<double>(static_cast<std::uint64_t>(den));
}

}  // namespace

std::shared_ptr<const Lattice> make_scaled_lattice(const Lattice& unscaled, const LatticeScale& scale,
                                                   int min_tier_bits) {
  const int exponent = unscaled.grid_exponent, unit = unscaled.points[0]->unit;
  std::array<std::shared_ptr<const PlacedPoints>, 2> points = unscaled.points;
  int bits = 0;
  for (std::uint32_t op = 0; op < 2; ++op)
    bits = std::max(
        bits, points[op]->bits(exponent) +
                  (op == scale.op ? std::max(factor_bits(scale.x), factor_bits(scale.y)) : factor_bits(scale.den)));
  auto stretched = std::make_shared<PlacedPoints>(*points[scale.op]);
  stretched->factors = {quotient(scale.x, scale.den), quotient(scale.y, scale.den)};
  position_in_units(*stretched, unit);
  points[scale.op] = std::move(stretched);
  return build_lattice({std::move(points), exponent, unit, bits, unscaled.integers}, scale, min_tier_bits);
}

}  // namespace dymsum::planar
