#include "planar/scaling/base.h"

#include <algorithm>

namespace dymsum::planar {

Result<std::shared_ptr<const ScalingBase>> ScalingBase::create(const Region& p, const Region& q, std::uint32_t scaled,
                                                               int min_tier_bits) {
  const std::array<EngineRegion, 2> regions{separate_touching(p.data(), p.touching_points()),
                                            separate_touching(q.data(), q.touching_points())};
  return create(regions, {}, scaled, min_tier_bits);
}

Result<std::shared_ptr<const ScalingBase>> ScalingBase::create(const std::array<EngineRegion, 2>& regions,
                                                               const std::array<std::vector<Point>, 2>& further, std::uint32_t scaled,
                                                               int min_tier_bits) {
  auto base = std::make_shared<ScalingBase>();
  base->scaled = scaled;
  base->min_tier_bits = min_tier_bits;
  std::array<std::vector<Point>, 2> vertices{source_vertices(regions[0].data()), source_vertices(regions[1].data())};
  for (int op = 0; op < 2; ++op) vertices[op].insert(vertices[op].end(), further[op].begin(), further[op].end());
  for (const auto& list : vertices)
    if (std::optional<Error> error = too_large(list)) return *std::move(error);
  base->lattice = make_lattice(vertices[0], vertices[1], min_tier_bits);
  for (std::uint32_t op = 0; op < 2; ++op) {
    base->operands[op] = make_operand(regions[op], op, *base->lattice);
    const Operand& o = base->operands[op];
    std::vector<std::uint32_t>& numbers = base->source_of[op];
    for (std::uint32_t i = 0; i < o.size(); ++i) {
      if (o.vertex_number[i] == SumVertex::kNone) continue;
      if (o.vertex_number[i] >= numbers.size()) numbers.resize(o.vertex_number[i] + 1, 0);
      numbers[o.vertex_number[i]] = o.source[i];
    }
    std::vector<std::array<std::uint32_t, 2>>& ends = base->ends_of[op];
    for (std::uint32_t i = 0; i < o.size(); ++i) {
      if (o.edge_number[i] == SumVertex::kNone) continue;
      if (o.edge_number[i] >= ends.size()) ends.resize(o.edge_number[i] + 1, {0, 0});
      ends[o.edge_number[i]] = {o.source[i], o.source[o.next[i]]};
    }
    for (const Component& c : o.components) base->regular &= c.dimension == 2;
    base->connected &= o.components.size() == 1;
    for (const double x : base->lattice->x[op]) base->width[op] = std::max(base->width[op], x);
    for (const double y : base->lattice->y[op]) base->height[op] = std::max(base->height[op], y);
  }
  return std::shared_ptr<const ScalingBase>(std::move(base));
}

LatticeScale ScalingBase::lattice_scale(const ScaleValue& x, const ScaleValue& y) const {
  if (x == y) return {x.num, x.num, x.den, scaled};
  const exact::BigInteger common = boost::multiprecision::lcm(x.den, y.den);
  return {exact::BigInteger(x.num * (common / x.den)), exact::BigInteger(y.num * (common / y.den)), common, scaled};
}

std::unique_ptr<Lattice> ScalingBase::lattice_at(const LatticeScale& scale) const {
  return make_scaled_lattice(*lattice, scale, min_tier_bits);
}

std::unique_ptr<Operand> ScalingBase::operand_at(std::uint32_t op, const Lattice& at) const {
  auto o = std::make_unique<Operand>(operands[op]);
  if (op != scaled) return o;
  for (std::uint32_t i = 0; i < o->size(); ++i) {
    const Point d = at.vector(o->edge(i));
    o->ex[i] = d.x;
    o->ey[i] = d.y;
  }
  return o;
}

// Sums of vertices need no lattice: (p - p') num + (q - q') den, with P and Q the other way round when Q scales.
std::optional<int> ScalingSource::compare_corners(const SumVertex& a, const SumVertex& b, int axis) const {
  const Lattice& l = *base_->lattice;
  if (a.corner_p == SumVertex::kNone || b.corner_p == SumVertex::kNone || l.tier_bits == 0) return std::nullopt;
  const SharedIntegers& integers = l.unscaled_integers();
  exact::BigInteger sum = 0;
  for (std::uint32_t op = 0; op < 2; ++op) {
    const std::uint32_t i = base_->source_of[op][op == 0 ? a.corner_p : a.corner_q], j = base_->source_of[op][op == 0 ? b.corner_p : b.corner_q];
    const exact::i128 d = integers.at[op][i][axis] - integers.at[op][j][axis];
    if (d == 0) continue;
    sum += exact::to_big(d).value() * (op != scale_.op ? scale_.den : axis == 0 ? scale_.x : scale_.y);
  }
  return sum.sign();
}

// Both lie on one contact whose edge is upright (axis 0) or level (axis 1): rectilinear shapes ask this all the time.
bool ScalingSource::on_common_line(const SumVertex& a, const SumVertex& b, int axis) const {
  const auto straight = [&](const Contact& c) {
    const std::uint32_t op = c.kind == Contact::Kind::edge_of_p ? 0 : 1, edge = op == 0 ? c.p : c.q;
    const auto [from, to] = base_->ends_of[op][edge];
    const Point &u = base_->lattice->input[op][from], &v = base_->lattice->input[op][to];
    return axis == 0 ? u.x == v.x : u.y == v.y;
  };
  for (const Contact& c : {a.in, a.out})
    if ((c == b.in || c == b.out) && straight(c)) return true;
  return false;
}

int ScalingSource::compare_x(const SumVertex& a, const SumVertex& b) const {
  if (on_common_line(a, b, 0)) return 0;
  const std::optional<int> sign = compare_corners(a, b, 0);
  return sign ? *sign : source().compare_x(a, b);
}

int ScalingSource::compare_y(const SumVertex& a, const SumVertex& b) const {
  if (on_common_line(a, b, 1)) return 0;
  const std::optional<int> sign = compare_corners(a, b, 1);
  return sign ? *sign : source().compare_y(a, b);
}

const SumSource& ScalingSource::source() const {
  std::call_once(made_, [this] {
    std::shared_ptr<const Lattice> lattice = base_->lattice_at(scale_);
    source_ = std::make_unique<SumSource>(lattice, base_->operand_at(0, *lattice), base_->operand_at(1, *lattice));
  });
  return *source_;
}

}  // namespace dymsum::planar
