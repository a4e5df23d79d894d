#include "spatial/local/local_boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spatial/convex/exact_positions.h"
#include "spatial/sum/solid_boundary.h"

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

namespace {

using Scopes = ClipWalls::Scopes;

bool overlaps_at(SumSpace& space, const exact::BigInteger& scale, const Collision& collision, const Centre& centre) {
  const std::optional<PointSource> at =
      space.add_position({centre.at[0] * scale, centre.at[1] * scale, centre.at[2] * scale});
  return at && collision.overlaps({*at, 0, 0, 0, 0, 0});
}

class LocalStages {
 public:
  LocalStages(SolidBoundary& result, const Scopes& scopes, const Collision& collision, StageWatch& watch)
      : result_(result), arrangement_(*result.arrangement), scopes_(scopes), collision_(collision), watch_(watch) {}

  /// One test for each patch in the larger box.
  void judge_patches() {
    const ArrangementScope linked{{}, scopes_.within_linked, scopes_.within.cells};
    const CellLinks links = link_cells(*result_.space, arrangement_, watch_, &linked);
    enum class Verdict : std::uint8_t { unknown, outside, covered };
    std::vector<Verdict> verdict(links.patches, Verdict::unknown);
    result_.boundary.assign(arrangement_.cell_count, false);
    for_each_cell([&](const PlaneGroup& group, std::uint32_t id, const Cell& cell) {
      if (links.patch[id] == kNoId) return;
      Verdict& known = verdict[links.patch[id]];
      if (known == Verdict::unknown) known = is_free(group, cell, facing(cell)) ? Verdict::outside : Verdict::covered;
      result_.boundary[id] = known == Verdict::outside;
    });
  }

  /// Every cell by itself.
  void judge_cells() {
    result_.boundary.assign(arrangement_.cell_count, false);
    for_each_cell([&](const PlaneGroup& group, std::uint32_t id, const Cell& cell) {
      result_.boundary[id] = is_free(group, cell, 1) != is_free(group, cell, -1);
    });
  }

  /// Finds tight features in the larger box, so that all is known around what lies in the box; keeps only what lies
  /// there.
  void find_tight(bool every_position) {
    const ArrangementScope looked_at{scopes_.inside.points, scopes_.within.edges, scopes_.within.cells};
    result_.tight = tight_features(*result_.space, result_.table, arrangement_, result_.boundary, collision_,
                                   every_position, watch_, &looked_at);
    std::erase_if(result_.tight.cells, [&](std::uint32_t c) { return !scopes_.inside.cells[c]; });
    std::erase_if(result_.tight.segments, [&](const std::array<PointId, 2>& s) {
      return !scopes_.inside.points[s[0]] || !scopes_.inside.points[s[1]];
    });
  }

  /// Cells of the boundary that lie in the box, in pieces that hang together there.
  void keep_inside() {
    const ArrangementScope linked{{}, scopes_.inside_linked, scopes_.inside.cells};
    result_.patch = link_cells(*result_.space, arrangement_, watch_, &linked).patch;
    for (std::uint32_t c = 0; c < arrangement_.cell_count; ++c)
      if (!scopes_.inside.cells[c]) result_.boundary[c] = false;
  }

  bool is_empty() const {
    return std::find(result_.boundary.begin(), result_.boundary.end(), true) == result_.boundary.end() &&
           result_.tight.cells.empty() && result_.tight.segments.empty() && result_.tight.points.empty();
  }

 private:
  template <class F>
  void for_each_cell(F f) const {
    for (const PlaneGroup& group : arrangement_.groups)
      for (std::uint32_t c = 0; c < group.cells.cells.size(); ++c) f(group, group.first_cell + c, group.cells.cells[c]);
  }
  static int facing(const Cell& cell) { return cell.front > 0 ? 1 : -1; }
  bool is_free(const PlaneGroup& group, const Cell& cell, int side) const {
    if (collision_.tests() % 16 == 15) watch_.query(0);
    return !collision_.meets(flag_at(arrangement_, group, cell, side));
  }

  SolidBoundary& result_;
  const SolidArrangement& arrangement_;
  const Scopes& scopes_;
  const Collision& collision_;
  StageWatch& watch_;
};

}  // namespace

bool comes_near(const SumSpace& space, const SumFacet& facet, const Box& box) {
  Box of;
  for (int k = 0; k < facet.corners; ++k) of.add(space.approx(facet.corner[static_cast<std::size_t>(k)]));
  return overlap(of, box);
}

LocalBoundary local_boundary(PosedSpace& space, ReducedConvolution convolution, const SolidPair& pair, ClipWalls& walls,
                             const Centre& centre, const SpatialOptions& options, SpatialStats& stats,
                             StageWatch& watch) {
  const bool brute = options.engine == SpatialEngine::brute;
  const auto vertices = static_cast<std::uint32_t>(pair.p.vertices.size());
  LocalBoundary local;
  SolidBoundary& result = local.boundary;
  result.space = std::move(space.space);
  result.table = facet_table(*result.space, convolution, watch);
  if (!brute) find_inner_edges(*result.space, pair.p, pair.q, result.table);
  walls.add_planes(*result.space, vertices);
  watch.begin("contacts");
  const Box reach = walls.reach(*result.space, vertices);
  Contacts contacts = find_contacts(*result.space, result.table, watch, brute ? nullptr : &reach);
  stats.box_pairs = contacts.counts.box_pairs, stats.contacts = contacts.counts.contacts;
  watch.begin("arrangement");
  const std::vector<PlaneCut> cuts = plane_cuts(*result.space, result.table, walls.planes());
  result.arrangement =
      std::make_unique<SolidArrangement>(arrange(*result.space, result.table, std::move(contacts), watch, cuts));
  const Scopes scopes = walls.scopes(*result.space, *result.arrangement);
  watch.begin("collisions");
  const Collision collision(*result.space, pair.p, pair.q);
  LocalStages stages(result, scopes, collision, watch);
  if (brute) stages.judge_cells();
  else stages.judge_patches();
  stats.collision_tests = collision.tests();
  watch.begin("tight features");
  if (options.tight) stages.find_tight(brute);
  stages.keep_inside();
  if (centre.always || stages.is_empty())
    local.centre_inside = overlaps_at(*result.space, space.scale, collision, centre);
  watch.begin("");
  stats.bits = result.space->bits();
  stats.points = result.arrangement->points.size(), stats.cells = result.arrangement->cell_count;
  stats.tight_tests = result.tight.tests;
  stats.double_pair_signs = result.space->signs().at(exact::Rung::double_pairs);
  stats.exact_signs = result.space->signs().exact();
  return local;
}

}  // namespace dymsum::spatial
