#include "planar/motion/operand_pair.h"

#include <cmath>
#include <string>

#include "base/double_text.h"
#include "exact/grid.h"
#include "planar/motion/orientation.h"
#include "planar/operand/prepared_region.h"
#include "planar/position/exact_source.h"

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
  base->given = base->lattice = make_lattice(points[0], points[1], min_tier_bits, Further::lattices);
  if (spread == Spread::narrow && base->lattice->wide) return too_far_apart(*base->lattice);
  base->place({placed_on(*base->lattice, kept[0]), placed_on(*base->lattice, kept[1])});
  for (const Operand& o : base->operands) {
    for (const Component& c : o.components) base->regular &= c.dimension == 2;
    base->connected &= o.components.size() == 1;
  }
  return std::shared_ptr<const OperandPair>(std::move(base));
}

void OperandPair::place(const std::array<std::shared_ptr<const Operand>, 2>& placed) {
  for (std::uint32_t op = 0; op < 2; ++op) {
    operands[op] = *placed[op];
    width[op] = operands[op].points->width;
    height[op] = operands[op].points->height;
  }
}

// Coordinates of moderate size are stretched and scaled, and two of them multiplied; where units are chosen for their
// spread, products may underflow as far as they do without a factor.
static_assert(2 * (PlacedPoints::kModerateBits + 65 + OperandPair::kFactorBits) <= 1022);
bool OperandPair::may_be_stretched() const {
  return given->points[moved]->bits(given->grid_exponent) + kFactorBits <= kNarrowBits;
}

std::shared_ptr<const OperandPair> OperandPair::stretched(const ScaleValue& x, const ScaleValue& y) const {
  auto made = std::make_shared<OperandPair>();
  made->moved = moved;
  made->min_tier_bits = min_tier_bits;
  made->given = given;
  made->lattice = lattice_at(lattice_scale(x, y));
  made->regular = regular;
  made->connected = connected;
  made->factors_ = {x, y};
  made->place({operand_at(0, *made->lattice), operand_at(1, *made->lattice)});
  return made;
}

LatticeScale OperandPair::lattice_scale(const ScaleValue& x, const ScaleValue& y) const {
  if (x == y) return {x.num, x.num, x.den, moved};
  const exact::BigInteger common = boost::multiprecision::lcm(x.den, y.den);
  return {exact::BigInteger(x.num * (common / x.den)), exact::BigInteger(y.num * (common / y.den)), common, moved};
}

LatticeScale OperandPair::lattice_scale(const ScaleValue& s) const {
  const auto along = [&](const ScaleValue& factors) {
    if (factors == ScaleValue{}) return s;
    return scale_value(exact::BigRational(rational(s) * rational(factors)));
  };
  return lattice_scale(along(factors_[0]), along(factors_[1]));
}

std::shared_ptr<const Lattice> OperandPair::lattice_at(const Placement& at) const {
  if (const auto* scale = std::get_if<LatticeScale>(&at)) return make_scaled_lattice(*given, *scale, min_tier_bits);
  return make_turned_lattice(*lattice, turn_of(std::get<Orientation>(at), moved), min_tier_bits);
}

std::shared_ptr<const Operand> OperandPair::operand_at(std::uint32_t op, const Lattice& at) const {
  return placed_on(at, std::shared_ptr<const Operand>(shared_from_this(), &operands[op]));
}

PlacedPair OperandPair::placed_on_lattice(std::shared_ptr<const Lattice> at) const {
  const Lattice& l = *at;
  return {std::move(at), operand_at(0, l), operand_at(1, l)};
}

Result<std::shared_ptr<const OperandPair>> pair_of_regions(const Region& p, const Region& q,
                                                           const PairOptions& options) {
  return OperandPair::create({prepared_operand(p, 0), prepared_operand(q, 1, options.reflect_q)}, options.further,
                             options.moved, options.min_tier_bits, options.spread);
}

Result<std::shared_ptr<const OperandPair>> pair_of_regions(const Region& p, const Region& q,
                                                           const MovingOptions& options) {
  if (!(options.window >= 0) || std::isinf(options.window))
    return Error{ErrorCode::out_of_range,
                 "the window must be finite and at least 0, not " + base::general_text(options.window, 6),
                 {}};
  if (options.threads < 0)
    return Error{ErrorCode::out_of_range, "threads must be at least 0, not " + std::to_string(options.threads), {}};
  return pair_of_regions(p, q,
                         PairOptions{.moved = options.moving == MovingOperand::p ? 0U : 1U,
                                     .reflect_q = options.reflect_q,
                                     .min_tier_bits = SumInternals::min_tier_bits(options)});
}

}  // namespace dymsum::planar
