#include "planar/frames/operand_pair.h"

#include <string>

#include "exact/grid.h"

namespace dymsum::planar {
namespace {

// The vertex that needs the finest grid.
Error too_far_apart(const Lattice& lattice) {
  Error error{ErrorCode::unsupported_operand,
              "sums that move need operands that reach less than 2^920 times as far as the finest step of their "
              "coordinates; this one takes steps of 2^" +
                  std::to_string(lattice.grid_exponent),
              {}};
  for (const auto& points : lattice.points)
    for (const Point& v : points->input)
      if (v != Point{} && exact::common_exponent({&v, 1}) == lattice.grid_exponent) {
        error.evidence.x = v.x;
        error.evidence.y = v.y;
        return error;
      }
  return error;
}

}  // namespace

Result<std::shared_ptr<const OperandPair>> OperandPair::create(
    const std::array<std::shared_ptr<const Operand>, 2>& kept, const std::array<std::vector<Point>, 2>& further,
    std::uint32_t moved, int min_tier_bits, Spread spread) {
  auto base = std::make_shared<OperandPair>();
  base->moved = moved;
  base->min_tier_bits = min_tier_bits;
  std::array<std::shared_ptr<const PlacedPoints>, 2> points;
  for (std::uint32_t op = 0; op < 2; ++op) {
    if (std::optional<Error> error = too_large(*kept[op])) return *std::move(error);
    points[op] = kept[op]->points;
    if (further[op].empty()) continue;
    std::vector<Point> all = points[op]->input;
    all.insert(all.end(), further[op].begin(), further[op].end());
    points[op] = place_points(std::move(all));
    if (std::optional<Error> error = too_large(*points[op])) return *std::move(error);
  }
  base->lattice = make_lattice(points[0], points[1], min_tier_bits, Further::lattices);
  if (spread == Spread::narrow && base->lattice->wide) return too_far_apart(*base->lattice);
  for (std::uint32_t op = 0; op < 2; ++op) {
    base->operands[op] = *placed_on(*base->lattice, kept[op]);
    const Operand& o = base->operands[op];
    for (const Component& c : o.components) base->regular &= c.dimension == 2;
    base->connected &= o.components.size() == 1;
    base->width[op] = o.points->width;
    base->height[op] = o.points->height;
  }
  return std::shared_ptr<const OperandPair>(std::move(base));
}

LatticeScale OperandPair::lattice_scale(const ScaleValue& x, const ScaleValue& y) const {
  if (x == y) return {x.num, x.num, x.den, moved};
  const exact::BigInteger common = boost::multiprecision::lcm(x.den, y.den);
  return {exact::BigInteger(x.num * (common / x.den)), exact::BigInteger(y.num * (common / y.den)), common, moved};
}

std::shared_ptr<const Lattice> OperandPair::lattice_at(const LatticeScale& scale) const {
  return make_scaled_lattice(*lattice, scale, min_tier_bits);
}

std::shared_ptr<const Operand> OperandPair::operand_at(std::uint32_t op, const Lattice& at) const {
  return placed_on(at, std::shared_ptr<const Operand>(shared_from_this(), &operands[op]));
}

PlacedPair OperandPair::placed_on_lattice(std::shared_ptr<const Lattice> at) const {
  const Lattice& l = *at;
  return {std::move(at), operand_at(0, l), operand_at(1, l)};
}

}  // namespace dymsum::planar
