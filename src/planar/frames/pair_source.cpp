#include "planar/frames/pair_source.h"

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

}  // namespace dymsum::planar
