// Lattices of which one operand is rotated: its vertices are integers over the rotation's denominator, never snapped.
#include <algorithm>
#include <cmath>

#include "planar/operand/lattice_build.h"

namespace dymsum::planar {

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

}  // namespace dymsum::planar
