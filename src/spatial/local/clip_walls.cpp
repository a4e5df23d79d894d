#include "spatial/local/clip_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spatial/convex/exact_positions.h"

namespace dymsum::spatial {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::array<double, 9> matrix_in_doubles(const SolidPose& pose) {
  const ExactPose exact = ExactPose::of(pose);
  std::array<double, 9> m;
  for (std::size_t k = 0; k < 9; ++k) m[k] = exact::round_to_double(exact.matrix[k], exact.den);
  return m;
}

void add_bounds(const SolidOperand& operand, const SolidPose& pose, SumBounds& sum) {
  const std::array<double, 9> m = matrix_in_doubles(pose);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = kInfinite, high = -kInfinite, size = 0;
    for (const Point3& v : operand.vertices) {
      const double parts[3] = {m[3 * axis] * v.x, m[3 * axis + 1] * v.y, m[3 * axis + 2] * v.z};
      const double at = parts[0] + parts[1] + parts[2];
      low = std::min(low, at), high = std::max(high, at);
      size = std::max(size, std::abs(parts[0]) + std::abs(parts[1]) + std::abs(parts[2]));
    }
    sum.low[axis] += low - size * 0x1p-45, sum.high[axis] += high + size * 0x1p-45;
  }
}

/// The walls of the larger box: near, and no longer than they have to be as numbers.
double next_below(double v, double step) {
  const double below = (std::floor(v / step) - 1) * step;
  return below < v ? below : std::nextafter(v, -kInfinite);
}

double coordinate_of(const Point3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

SumBounds sum_bounds(const SolidPair& pair, const PosePair& poses) {
  SumBounds sum;
  add_bounds(pair.p, poses.p, sum), add_bounds(pair.q, poses.q, sum);
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!std::isfinite(sum.low[axis]) || !std::isfinite(sum.high[axis]))
      sum.low[axis] = -kInfinite, sum.high[axis] = kInfinite;
  return sum;
}

ClipWalls::ClipWalls(const ClipBox& box, const SumBounds& bounds, bool with_margin) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    const double low = coordinate_of(box.low, axis), high = coordinate_of(box.high, axis);
    misses_ = misses_ || high < bounds.low[k] || low > bounds.high[k];
    const bool from_below = !(low < bounds.low[k]), from_above = !(high > bounds.high[k]);
    if (from_below) add_wall({axis, low}, 1, false);
    if (from_above) add_wall({axis, high}, -1, false);
    if (!with_margin) continue;
    const double extent = std::min(high, bounds.high[k]) - std::max(low, bounds.low[k]);
    const double step = std::isfinite(extent) && extent > 0 ? std::ldexp(1.0, std::ilogb(extent) - 5) : 1.0;
    if (from_below) add_wall({axis, next_below(low, step)}, 1, true);
    if (from_above) add_wall({axis, -next_below(-high, step)}, -1, true);
  }
}

void ClipWalls::add_wall(const AxisLevel& level, int inward, bool outer) {
  walls_.push_back({level.axis, inward, outer});
  levels_.push_back(level);
}

void ClipWalls::add_planes(SumSpace& space, std::uint32_t vertices) {
  std::vector<PlaneSource> sources;
  for (std::uint32_t k = 0; k < walls_.size(); ++k) {
    const auto axis = static_cast<std::uint32_t>(walls_[k].axis);
    sources.push_back({{vertices + k, 0},
                       {DirectionSource::Of::axis, (axis + 1) % 3, 0},
                       {DirectionSource::Of::axis, (axis + 2) % 3, 0},
                       false});
  }
  const PlaneId first = space.add_planes(sources);
  for (std::uint32_t k = 0; k < walls_.size(); ++k) planes_.push_back(first + k);
}

Box ClipWalls::reach(const SumSpace& space, std::uint32_t vertices) const {
  const double far = 2 * space.span();
  Box box{{-far, -far, -far}, {far, far, far}};
  for (std::uint32_t k = 0; k < walls_.size(); ++k) {
    if (!walls_[k].outer) continue;
    const int axis = walls_[k].axis;
    const Vec3 v = space.approx(SumPoint{vertices + k, 0});
    const double at = axis == 0 ? v.x : axis == 1 ? v.y : v.z;
    Vec3& end = walls_[k].inward > 0 ? box.low : box.high;
    (axis == 0 ? end.x : axis == 1 ? end.y : end.z) = at;
  }
  box.grow(4 * space.sum_radius());
  return box;
}

namespace {

/// Whether a point lies outside one box, and the walls of the box that it lies in.
struct WallSides {
  bool outside = false;
  std::uint32_t on = 0;
};

void mark_scope(const SolidArrangement& all, const std::vector<WallSides>& sides, ArrangementScope& scope,
                std::vector<bool>& linked) {
  for (const WallSides& s : sides) scope.points.push_back(!s.outside);
  for (const auto& [a, b] : all.edge_ends) {
    scope.edges.push_back(scope.points[a] && scope.points[b]);
    linked.push_back(scope.edges.back() && (sides[a].on & sides[b].on) == 0);
  }
  for (const PlaneGroup& group : all.groups) {
    const PlaneCells& cells = group.cells;
    for (const Cell& cell : cells.cells) {
      // Cells are not crossed by walls, and the outer loop has the whole cell in its hull.
      bool inside = true;
      for (std::uint32_t k = cells.loops[cell.first_loop]; k < cells.loops[cell.first_loop + 1] && inside; ++k) {
        const CellEdge& e = cells.edges[cells.half_edges[k] / 2];
        inside = scope.points[all.point(group, e.a)] && scope.points[all.point(group, e.b)];
      }
      scope.cells.push_back(inside);
    }
  }
}

}  // namespace

ClipWalls::Scopes ClipWalls::scopes(const SumSpace& space, const SolidArrangement& arrangement) const {
  std::vector<WallSides> inside(arrangement.points.size()), within(arrangement.points.size());
  for (PointId p = 0; p < arrangement.points.size(); ++p) {
    for (std::size_t k = 0; k < walls_.size(); ++k) {
      WallSides& sides = walls_[k].outer ? within[p] : inside[p];
      const int side =
          walls_[k].inward * space.side(planes_[k], arrangement.points.source(p), arrangement.points.approx(p));
      if (side < 0) sides.outside = true;
      if (side == 0) sides.on |= std::uint32_t{1} << k;
    }
  }
  Scopes scopes;
  mark_scope(arrangement, inside, scopes.inside, scopes.inside_linked);
  mark_scope(arrangement, within, scopes.within, scopes.within_linked);
  return scopes;
}

}  // namespace dymsum::spatial
