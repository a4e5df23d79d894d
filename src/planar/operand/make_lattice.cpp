#include "planar/operand/make_lattice.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/doubles.h"
#include "exact/rounding_bound.h"
#include "planar/operand/fraction_lattice.h"

namespace dymsum::planar {

// Points of operands in the units of a lattice.

namespace {

struct Corners {
  Point low, high;
};

// The corners of the bounding box: their coordinates are coordinates of vertices, hence on the grid.
Corners corners_of(std::span<const Point> points) {
  if (points.empty()) return {};
  Point low = points[0], high = low;
  for (const Point p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {low, high};
}

// The largest coordinates are those of the high corner: rounding is monotone, and nothing is stretched backwards.
void position_below(PlacedPoints& points, int unit, Point high) {
  const double per_unit = power_of_two(-unit);
  const Point offset = points.offset, factors = points.factors;
  // The difference of two doubles is rounded once; the power of two is exact.
  const auto position_x = [=](double x) { return (x - offset.x) * per_unit * factors.x; };
  const auto position_y = [=](double y) { return (y - offset.y) * per_unit * factors.y; };
  points.unit = unit;
  const std::size_t n = points.input.size();
  points.x.resize(n);
  points.y.resize(n);
  double *const x = points.x.data(), *const y = points.y.data();
  const Point* const input = points.input.data();
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = position_x(input[i].x);
    y[i] = position_y(input[i].y);
  }
  points.width = n == 0 ? 0 : position_x(high.x);
  points.height = n == 0 ? 0 : position_y(high.y);
}

}  // namespace

// One unit in the last place covers the rounding of the differences.
int top_of(double extent) {
  const int field = static_cast<int>(base::bit_cast<std::uint64_t>(extent) >> 52);
  if (field != 0 && field < 0x7ff) return field - 1022;  // the next double is at most the next power of two
  constexpr int kLow = -1100;                            // below all grids
  return kLow + exact::bits_needed(std::nextafter(extent, INFINITY), kLow);
}

void position_in_units(PlacedPoints& points, int unit) {
  if (points.fractions != nullptr) fractions_in_units(points, unit);
  else position_below(points, unit, corners_of(points.input).high);
}

int unit_for(double extent, int exponent, int bits) {
  return bits <= 61 ? std::max(exponent, -1000) : std::max(std::ilogb(extent) - 60, -1000);
}

std::shared_ptr<const PlacedPoints> place_points(std::vector<Point> input) {
  auto points = std::make_shared<PlacedPoints>();
  points->input = std::move(input);
  const Corners corners = corners_of(points->input);
  points->offset = corners.low;
  points->extent = std::max(corners.high.x - corners.low.x, corners.high.y - corners.low.y);
  points->exponent = exact::common_exponent(points->input);
  points->top = top_of(points->extent);
  const int unit = points->moderate() ? 0 : unit_for(points->extent, points->exponent, points->bits(points->exponent));
  position_below(*points, unit, corners.high);
  return points;
}

// Lattices of which one operand is rotated: its vertices are integers over the rotation's denominator, never snapped.

using exact::Big;
using exact::BigRational;

Point TurnedPoints::vector(std::uint32_t from, std::uint32_t to) const {
  if (at.empty()) {
    const auto component = [&](int axis) {
      const exact::BigInteger gap = big[to][axis] - big[from][axis];
      return with_sign_of(gap.sign(), exact::round_to_double(BigRational(BigRational(gap) * big_factor)));
    };
    return {component(0), component(1)};
  }
  return {static_cast<double>(at[to][0] - at[from][0]) * factor, static_cast<double>(at[to][1] - at[from][1]) * factor};
}

Point TurnedPoints::direction(std::uint32_t from, std::uint32_t to) const {
  if (at.empty()) {
    const exact::BigInteger x = big[to][0] - big[from][0], y = big[to][1] - big[from][1],
                            longer = std::max(exact::BigInteger(abs(x)), exact::BigInteger(abs(y)));
    const exact::BigInteger one = longer == 0 ? exact::BigInteger(1) : exact::BigInteger(1) << msb(longer);
    return {with_sign_of(x.sign(), exact::round_to_double(BigRational(x, one))),
            with_sign_of(y.sign(), exact::round_to_double(BigRational(y, one)))};
  }
  return {static_cast<double>(at[to][0] - at[from][0]), static_cast<double>(at[to][1] - at[from][1])};
}

double TurnedPoints::rounded(std::uint32_t i, int axis) const {
  return at.empty() ? exact::round_to_double(BigRational(BigRational(big[i][axis]) * big_factor))
                    : static_cast<double>(at[i][axis]) * factor;
}

int TurnedPoints::compare(std::uint32_t i, std::uint32_t j, int axis) const {
  if (at.empty()) return big[i][axis].compare(big[j][axis]);
  return (at[i][axis] > at[j][axis]) - (at[i][axis] < at[j][axis]);
}

namespace {

// (x, -turn; turn, y) times the grid integers, relative to the smallest coordinate of each axis; and the bits that
// needs.
std::shared_ptr<TurnedPoints> turned_points(const Lattice& unscaled, const LatticeScale& r) {
  const PlacedPoints& o = *unscaled.points[r.op];
  auto turned = std::make_shared<TurnedPoints>();
  const int grid_bits = o.bits(unscaled.grid_exponent);
  // |x X - turn Y| < 2^(grid + den + 1), and a difference of two has one bit more.
  if (grid_bits + factor_bits(r.den) + 2 <= 125 && unscaled.tier_bits != 0) {
    const exact::i128 c = exact::narrowed<exact::Int<125>>(Big(r.x)).raw(),
                      s = exact::narrowed<exact::Int<125>>(Big(r.turn)).raw();
    std::array<exact::i128, 2> low{};
    const auto& integers = unscaled.unscaled_integers().at[r.op];
    turned->at.reserve(integers.size());
    for (const auto& v : integers) turned->at.push_back({c * v[0] - s * v[1], s * v[0] + c * v[1]});
    if (!turned->at.empty()) low = turned->at[0];
    for (const auto& v : turned->at)
      for (int axis = 0; axis < 2; ++axis) low[axis] = std::min(low[axis], v[axis]);
    for (auto& v : turned->at)
      for (int axis = 0; axis < 2; ++axis) v[axis] -= low[axis];
    turned->low = {exact::to_big(low[0]).value(), exact::to_big(low[1]).value()};
    return turned;
  }
  for (const Point& v : o.input) {
    const exact::BigInteger x = exact::grid_coordinate<Big>(v.x, o.offset.x, unscaled.grid_exponent).value();
    const exact::BigInteger y = exact::grid_coordinate<Big>(v.y, o.offset.y, unscaled.grid_exponent).value();
    turned->big.push_back({exact::BigInteger(r.x * x - r.turn * y), exact::BigInteger(r.turn * x + r.y * y)});
  }
  if (!turned->big.empty()) turned->low = turned->big[0];
  for (const auto& v : turned->big)
    for (int axis = 0; axis < 2; ++axis) turned->low[axis] = std::min(turned->low[axis], v[axis]);
  for (auto& v : turned->big)
    for (int axis = 0; axis < 2; ++axis) v[axis] -= turned->low[axis];
  return turned;
}

// The integers as x and y, three roundings each.
void place_turned(PlacedPoints& points, std::shared_ptr<TurnedPoints> turned, const exact::BigInteger& den,
                  int exponent, int unit) {
  const int shift = exponent - unit;
  const exact::BigInteger power = exact::BigInteger(1) << std::abs(shift);
  turned->big_factor =
      shift < 0 ? BigRational(exact::BigInteger(1), exact::BigInteger(den * power)) : BigRational(power, den);
  turned->factor = turned->at.empty() ? 0 : exact::round_to_double(turned->big_factor);
  points.unit = unit;
  points.width = points.height = 0;
  points.x.clear();
  points.y.clear();
  for (std::uint32_t i = 0; i < turned->size(); ++i) {
    points.x.push_back(turned->rounded(i, 0));
    points.y.push_back(turned->rounded(i, 1));
    points.width = std::max(points.width, points.x.back());
    points.height = std::max(points.height, points.y.back());
  }
  points.turned = std::move(turned);
}

}  // namespace

// (x, -turn; turn, y) times the offset, and what was subtracted: integers over the denominator and the grid.
Point turned_offset(const PlacedPoints& points, const LatticeScale& r, int grid_exponent) {
  const exact::BigInteger x = exact::grid_coordinate<Big>(points.offset.x, grid_exponent).value();
  const exact::BigInteger y = exact::grid_coordinate<Big>(points.offset.y, grid_exponent).value();
  const exact::BigInteger power = exact::BigInteger(1) << std::abs(grid_exponent);
  const auto rounded = [&](const exact::BigInteger& n) {
    return exact::round_to_double(grid_exponent < 0 ? BigRational(n, exact::BigInteger(r.den * power))
                                                    : BigRational(exact::BigInteger(n * power), r.den));
  };
  return {rounded(exact::BigInteger(r.x * x - r.turn * y + points.turned->low[0])),
          rounded(exact::BigInteger(r.y * y + r.turn * x + points.turned->low[1]))};
}

std::shared_ptr<const Lattice> make_turned_lattice(const Lattice& unscaled, const LatticeScale& rotation,
                                                   int min_tier_bits) {
  const int exponent = unscaled.grid_exponent, unit = unscaled.points[0]->unit;
  std::array<std::shared_ptr<const PlacedPoints>, 2> points = unscaled.points;
  const std::uint32_t op = rotation.op;
  const int den = factor_bits(rotation.den);
  // Rotated differences are at most the diagonal: 1.5 times the larger side.
  int bits = std::max(points[op]->bits(exponent) + den + 1, points[1 - op]->bits(exponent) + den);
  auto placed = std::make_shared<PlacedPoints>(*points[op]);
  std::shared_ptr<TurnedPoints> turned = turned_points(unscaled, rotation);
  // Integers that were too wide to be turned in 125 bits may seem to fit by one bit.
  if (turned->at.empty()) bits = std::max(bits, exact::coordinate_bits(exact::Tier::b512) + 1);
  place_turned(*placed, std::move(turned), rotation.den, exponent, unit);
  points[op] = std::move(placed);
  return build_lattice({std::move(points), exponent, unit, bits, unscaled.integers}, rotation, min_tier_bits);
}

// The lattice that operands get: the grid that holds both, the unit of the doubles, and what is determined in doubles.

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
