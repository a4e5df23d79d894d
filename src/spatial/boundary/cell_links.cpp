#include "spatial/boundary/cell_links.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace dymsum::spatial {

namespace {

constexpr std::int8_t kNoWall = 2;  // of a cell's facing: it is looked through

/// Half of a plane at an edge, covered by a cell.
struct Wall {
  PlaneId plane;
  bool left;
  std::uint32_t cell;
};

/// The pairs of cells that look into one wedge around an edge.
class Wedges {
 public:
  Wedges(const SumSpace& space, const SolidArrangement& arrangement, const std::vector<std::int8_t>& facing)
      : space_(space), arrangement_(arrangement), facing_(facing) {}

  void link_edge(std::uint32_t edge, std::vector<std::array<std::uint32_t, 2>>& joins) {
    walls_.clear();
    for (const EdgeUse use : arrangement_.uses(edge)) {
      const PlaneGroup& group = arrangement_.groups[use.group];
      const CellEdge& e = group.cells.edges[use.edge];
      const bool up = arrangement_.point(group, e.a) < arrangement_.point(group, e.b);
      const std::uint32_t left = up ? e.left : e.right, right = up ? e.right : e.left;
      add_wall(group, true, left);
      add_wall(group, false, right);
    }
    if (walls_.size() > 2) sort_around(arrangement_.edge_ends[edge]);
    for (std::size_t k = 0; k < walls_.size(); ++k) {
      const std::uint32_t x = looking(walls_[k], true), y = looking(walls_[(k + 1) % walls_.size()], false);
      if (x != y) joins.push_back({x, y});
    }
  }

 private:
  std::uint32_t covered() const { return arrangement_.cell_count; }
  void add_wall(const PlaneGroup& group, bool left, std::uint32_t cell) {
    if (cell != kNoId && facing_[group.first_cell + cell] != kNoWall)
      walls_.push_back({group.plane, left, group.first_cell + cell});
  }
  /// The cell whose free side looks counter-clockwise (or clockwise) around the edge from the wall, or what is covered.
  std::uint32_t looking(const Wall& wall, bool counter_clockwise) const {
    // Counter-clockwise of the left half lies the normal's side, of the right half the other one.
    const int side = wall.left == counter_clockwise ? 1 : -1;
    return facing_[wall.cell] == side ? wall.cell : covered();
  }

  /// Counter-clockwise seen against the way from a to b.
  void sort_around(const std::array<PointId, 2>& edge) {
    const Approx &a = arrangement_.points.approx(edge[0]), &b = arrangement_.points.approx(edge[1]);
    const Vec3 d = b.at - a.at;
    axis_ = std::abs(d.x) >= std::abs(d.y) && std::abs(d.x) >= std::abs(d.z) ? 0
            : std::abs(d.y) >= std::abs(d.z)                                 ? 1
                                                                             : 2;
    along_ = 0;
    const double gap = axis_ == 0 ? d.x : axis_ == 1 ? d.y : d.z;
    if (std::abs(gap) > 2 * (a.radius + b.radius) + space_.span() * 0x1p-50) along_ = gap > 0 ? 1 : -1;
    for (int k = 0; k < 3 && along_ == 0; ++k) {
      axis_ = k;
      along_ = space_.exact_order(arrangement_.points.source(edge[0]), arrangement_.points.source(edge[1]), k);
    }
    const Wall reference = walls_[0];
    const auto sector = [&](const Wall& w) {
      if (w.plane == reference.plane) return w.left == reference.left ? 0 : 2;
      return turn(reference, w) > 0 ? 1 : 3;
    };
    std::sort(walls_.begin(), walls_.end(), [&](const Wall& x, const Wall& y) {
      const int a = sector(x), b = sector(y);
      if (a != b) return a < b;
      return turn(x, y) > 0;
    });
  }
  /// The sign of the turn around the edge from one half-plane to another: (n x d) x (m x d) = d (d . (n x m)).
  int turn(const Wall& x, const Wall& y) const {
    if (x.plane == y.plane) return 0;
    const Vec3 c = cross(space_.plane(x.plane).n, space_.plane(y.plane).n);
    const double v = axis_ == 0 ? c.x : axis_ == 1 ? c.y : c.z;
    const int s = v > 0x1p-47 ? 1 : v < -0x1p-47 ? -1 : space_.exact_cross(x.plane, y.plane, axis_);
    return s * along_ * (x.left ? 1 : -1) * (y.left ? 1 : -1);
  }

  const SumSpace& space_;
  const SolidArrangement& arrangement_;
  const std::vector<std::int8_t>& facing_;
  std::vector<Wall> walls_;
  int axis_ = 0, along_ = 0;
};

}  // namespace

CellLinks link_cells(const SumSpace& space, const SolidArrangement& arrangement, StageWatch& watch,
                     const ArrangementScope* scope) {
  const std::uint32_t covered = arrangement.cell_count;
  std::vector<std::int8_t> facing;  // 1 where the free side is the normal's, -1 the other one, 0 none
  facing.reserve(covered);
  for (const PlaneGroup& group : arrangement.groups)
    for (const Cell& cell : group.cells.cells)
      facing.push_back(cell.front > 0 ? cell.back > 0 ? 0 : 1 : cell.back > 0 ? -1 : kNoWall);
  for (std::uint32_t c = 0; c < covered && scope != nullptr; ++c)
    if (!scope->cells[c]) facing[c] = kNoWall;

  constexpr std::size_t kPart = 2048;
  const std::size_t edges = arrangement.edge_ends.size();
  std::vector<std::vector<std::array<std::uint32_t, 2>>> joins((edges + kPart - 1) / kPart);
  watch.run(joins.size(), [&](std::size_t part) {
    Wedges wedges(space, arrangement, facing);
    for (std::size_t e = part * kPart; e < std::min(edges, (part + 1) * kPart); ++e)
      if (scope == nullptr || scope->edges[e]) wedges.link_edge(static_cast<std::uint32_t>(e), joins[part]);
  });

  std::vector<std::uint32_t> parent(covered + 1);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  for (std::uint32_t c = 0; c < covered; ++c)
    if (facing[c] == 0) parent[root(c)] = root(covered);
  for (const auto& part : joins)
    for (const auto& [x, y] : part) parent[root(x)] = root(y);

  CellLinks links;
  links.patch.assign(covered, kNoId);
  std::vector<std::uint32_t> index(parent.size(), kNoId);
  const std::uint32_t buried = root(covered);
  for (std::uint32_t c = 0; c < covered; ++c) {
    const std::uint32_t r = root(c);
    if (r == buried || facing[c] == kNoWall) continue;
    if (index[r] == kNoId) index[r] = links.patches++;
    links.patch[c] = index[r];
  }
  return links;
}

}  // namespace dymsum::spatial
