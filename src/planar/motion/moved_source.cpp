#include "planar/motion/moved_source.h"

#include "planar/motion/orientation_sum.h"

namespace dymsum::planar {

// Both lie on one contact whose edge is upright (axis 0) or level (axis 1): rectilinear shapes ask this all the time.
bool PairSource::on_common_line(const SumVertex& a, const SumVertex& b, int axis) const {
  const auto straight = [&](const Contact& c) {
    const std::uint32_t op = c.kind == Contact::Kind::edge_of_p ? 0 : 1;
    if (!keeps_axes(op)) return false;
    const auto [from, to] = base_->operands[op].numbered_edge[op == 0 ? c.p : c.q];
    const Point &u = base_->lattice->points[op]->input[from], &v = base_->lattice->points[op]->input[to];
    return axis == 0 ? u.x == v.x : u.y == v.y;
  };
  for (const Contact& c : {a.in, a.out})
    if ((c == b.in || c == b.out) && straight(c)) return true;
  return false;
}

int PairSource::compare(const SumVertex& a, const SumVertex& b, int axis) const {
  if (on_common_line(a, b, axis)) return 0;
  if (a.corner_p != SumVertex::kNone && b.corner_p != SumVertex::kNone)
    if (const std::optional<int> sign = compare_corners(a, b, axis)) return *sign;
  return axis == 0 ? source().compare_x(a, b) : source().compare_y(a, b);
}

const SumSource& PairSource::source() const {
  std::call_once(made_, [this] {
    PlacedPair at = placed();
    source_ = std::make_unique<SumSource>(std::move(at.lattice), std::move(at.p), std::move(at.q));
  });
  return *source_;
}

// Sums of vertices need no lattice: (p - p') num + (q - q') den, with P and Q the other way round when Q scales.
std::optional<int> ScaledSource::compare_corners(const SumVertex& a, const SumVertex& b, int axis) const {
  const Lattice& l = *base().given;
  if (l.tier_bits == 0) return std::nullopt;
  const SharedIntegers& integers = l.unscaled_integers();
  exact::BigInteger sum = 0;
  for (std::uint32_t op = 0; op < 2; ++op) {
    const auto& source = base().operands[op].numbered_vertex;
    const std::uint32_t i = source[op == 0 ? a.corner_p : a.corner_q], j = source[op == 0 ? b.corner_p : b.corner_q];
    const exact::i128 d = integers.at[op][i][axis] - integers.at[op][j][axis];
    if (d == 0) continue;
    sum += exact::to_big(d).value() * (op != scale_.op ? scale_.den : axis == 0 ? scale_.x : scale_.y);
  }
  return sum.sign();
}

PlacedPair TurnedSource::placed() const { return placed_at(base(), theta_); }

// Sums with one vertex of the turning operand differ as the vertices that stand still do.
std::optional<int> TurnedSource::compare_corners(const SumVertex& a, const SumVertex& b, int axis) const {
  const std::uint32_t still = 1 - base().moved;
  if ((still == 0 ? a.corner_q : a.corner_p) != (still == 0 ? b.corner_q : b.corner_p)) return std::nullopt;
  const auto& source = base().operands[still].numbered_vertex;
  const std::vector<Point>& input = base().lattice->points[still]->input;
  const Point &u = input[source[still == 0 ? a.corner_p : a.corner_q]],
              &v = input[source[still == 0 ? b.corner_p : b.corner_q]];
  const double x = axis == 0 ? u.x : u.y, y = axis == 0 ? v.x : v.y;
  return x < y ? -1 : x > y;
}

}  // namespace dymsum::planar
