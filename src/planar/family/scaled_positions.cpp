#include "planar/family/scaled_positions.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {

using exact::BigRational;

namespace {

LatticeScale scale_of(const OperandPair& base, int s) { return base.lattice_scale(scale_value(BigRational(s))); }

double reach_of(const OperandPair& base, std::uint32_t op) {
  double reach = 0;
  for (const Point& v : base.lattice->points[op]->input) reach = std::max({reach, std::abs(v.x), std::abs(v.y)});
  return reach;
}

}  // namespace

ScaledPositions::ScaledPositions(std::shared_ptr<const OperandPair> base)
    : base_(base),
      ends_{FrameSource(base, scale_of(*base, 1)), FrameSource(base, scale_of(*base, 2))},
      still_(reach_of(*base, 1 - base->moved)),
      moved_(reach_of(*base, base->moved)) {}

void ScaledPositions::add(std::span<const SumVertex> vertices, double at) {
  for (const SumVertex& v : vertices) paths_.push_back(v.corner_p != SumVertex::kNone ? corner(v) : crossing(v, at));
}

ScaledPositions::Path ScaledPositions::corner(const SumVertex& v) const {
  const auto source = [&](std::uint32_t op) {
    return base_->operands[op].vertex_of_index[op == 0 ? v.corner_p : v.corner_q];
  };
  const std::uint32_t moved = base_->moved;
  const PlacedPoints &moves = *base_->lattice->points[moved], &stays = *base_->lattice->points[1 - moved];
  const Point m = moves.input[source(moved)], s = stays.input[source(1 - moved)];
  Path path{s.x, s.y, m.x * moves.factors.x, m.y * moves.factors.y};
  path.size = std::max(std::abs(path.x), std::abs(path.y));
  path.speed = std::max(std::abs(path.dx), std::abs(path.dy));
  return path;
}

ScaledPositions::Path ScaledPositions::crossing(const SumVertex& v, double at) const {
  const ExactSource::Position one = ends_[0].position(v), two = ends_[1].position(v);
  const BigRational dx = two.x - one.x, dy = two.y - one.y, from = exact::exact_value(at) - 1;
  Path path{exact::round_to_double(one.x + from * dx), exact::round_to_double(one.y + from * dy),
            exact::round_to_double(dx), exact::round_to_double(dy), at};
  path.size = std::max(std::abs(path.x), std::abs(path.y));
  path.speed = std::max(std::abs(path.dx), std::abs(path.dy));
  return path;
}

}  // namespace dymsum::planar
