#include "planar/frames/operand_pair.h"

#include "planar/operand/prepared_region.h"

namespace dymsum::planar {

Result<std::shared_ptr<const OperandPair>> OperandPair::create(const Region& p, const Region& q, std::uint32_t scaled,
                                                               int min_tier_bits) {
  return create({prepared_operand(p, 0), prepared_operand(q, 1)}, {}, scaled, min_tier_bits);
}

Result<std::shared_ptr<const OperandPair>> OperandPair::create(
    const std::array<std::shared_ptr<const Operand>, 2>& kept, const std::array<std::vector<Point>, 2>& further,
    std::uint32_t scaled, int min_tier_bits) {
  auto base = std::make_shared<OperandPair>();
  base->scaled = scaled;
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
  if (x == y) return {x.num, x.num, x.den, scaled};
  const exact::BigInteger common = boost::multiprecision::lcm(x.den, y.den);
  return {exact::BigInteger(x.num * (common / x.den)), exact::BigInteger(y.num * (common / y.den)), common, scaled};
}

std::shared_ptr<const Lattice> OperandPair::lattice_at(const LatticeScale& scale) const {
  return make_scaled_lattice(*lattice, scale, min_tier_bits);
}

std::shared_ptr<const Operand> OperandPair::operand_at(std::uint32_t op, const Lattice& at) const {
  return placed_on(at, std::shared_ptr<const Operand>(shared_from_this(), &operands[op]));
}

// Sums of vertices need no lattice: (p - p') num + (q - q') den, with P and Q the other way round when Q scales.
std::optional<int> PairSource::compare_corners(const SumVertex& a, const SumVertex& b, int axis) const {
  const Lattice& l = *base_->lattice;
  if (a.corner_p == SumVertex::kNone || b.corner_p == SumVertex::kNone || l.tier_bits == 0) return std::nullopt;
  const SharedIntegers& integers = l.unscaled_integers();
  exact::BigInteger sum = 0;
  for (std::uint32_t op = 0; op < 2; ++op) {
    const auto& source = base_->operands[op].numbered_vertex;
    const std::uint32_t i = source[op == 0 ? a.corner_p : a.corner_q], j = source[op == 0 ? b.corner_p : b.corner_q];
    const exact::i128 d = integers.at[op][i][axis] - integers.at[op][j][axis];
    if (d == 0) continue;
    sum += exact::to_big(d).value() * (op != scale_.op ? scale_.den : axis == 0 ? scale_.x : scale_.y);
  }
  return sum.sign();
}

// Both lie on one contact whose edge is upright (axis 0) or level (axis 1): rectilinear shapes ask this all the time.
bool PairSource::on_common_line(const SumVertex& a, const SumVertex& b, int axis) const {
  const auto straight = [&](const Contact& c) {
    const std::uint32_t op = c.kind == Contact::Kind::edge_of_p ? 0 : 1, edge = op == 0 ? c.p : c.q;
    const auto [from, to] = base_->operands[op].numbered_edge[edge];
    const Point &u = base_->lattice->points[op]->input[from], &v = base_->lattice->points[op]->input[to];
    return axis == 0 ? u.x == v.x : u.y == v.y;
  };
  for (const Contact& c : {a.in, a.out})
    if ((c == b.in || c == b.out) && straight(c)) return true;
  return false;
}

int PairSource::compare_x(const SumVertex& a, const SumVertex& b) const {
  if (on_common_line(a, b, 0)) return 0;
  const std::optional<int> sign = compare_corners(a, b, 0);
  return sign ? *sign : source().compare_x(a, b);
}

int PairSource::compare_y(const SumVertex& a, const SumVertex& b) const {
  if (on_common_line(a, b, 1)) return 0;
  const std::optional<int> sign = compare_corners(a, b, 1);
  return sign ? *sign : source().compare_y(a, b);
}

const SumSource& PairSource::source() const {
  std::call_once(made_, [this] {
    std::shared_ptr<const Lattice> lattice = base_->lattice_at(scale_);
    source_ = std::make_unique<SumSource>(lattice, base_->operand_at(0, *lattice), base_->operand_at(1, *lattice));
  });
  return *source_;
}

}  // namespace dymsum::planar
