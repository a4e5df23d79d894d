#include "spatial/boundary/cell_links.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

namespace dymsum::spatial {

namespace {

struct EdgeSide {
  PointId a, b;
  PlaneId plane;
  std::uint32_t left, right;  ///< cells, on the way from a to b seen against the plane's normal
};

/// Half of a plane at an edge, covered by a cell.
struct Wall {
  PlaneId plane;
  bool left;
  std::uint32_t cell;
};

class Linker {
 public:
  Linker(const SumSpace& space, const SolidArrangement& arrangement) : space_(space), arrangement_(arrangement) {}

  CellLinks run() {
    parent_.resize(arrangement_.cell_count + 1);  // the last one: what is covered
    std::iota(parent_.begin(), parent_.end(), 0u);
    for (const PlaneGroup& group : arrangement_.groups)
      for (const Cell& cell : group.cells.cells)
        facing_.push_back(cell.front > 0 ? cell.back > 0 ? 0 : 1 : cell.back > 0 ? -1 : kNoWall);
    for (std::uint32_t c = 0; c < facing_.size(); ++c)
      if (facing_[c] == 0) join(c, covered());
    std::vector<EdgeSide> sides = edge_sides();
    std::sort(sides.begin(), sides.end(), [](const EdgeSide& x, const EdgeSide& y) {
      return std::tie(x.a, x.b, x.plane, x.left, x.right) < std::tie(y.a, y.b, y.plane, y.left, y.right);
    });
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
      while (last < sides.size() && sides[last].a == sides[first].a && sides[last].b == sides[first].b) ++last;
      link_edge({&sides[first], last - first});
    }
    return numbered();
  }

 private:
  std::uint32_t covered() const { return arrangement_.cell_count; }
  std::uint32_t root(std::uint32_t c) {
    while (parent_[c] != c) c = parent_[c] = parent_[parent_[c]];
    return c;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

  std::vector<EdgeSide> edge_sides() const {
    std::vector<EdgeSide> sides;
    for (const PlaneGroup& group : arrangement_.groups) {
      const auto cell = [&](std::uint32_t c) {
        return c == kNoId || facing_[group.first_cell + c] == kNoWall ? kNoId : group.first_cell + c;
      };
      for (const CellEdge& e : group.cells.edges) {
        if (cell(e.left) == kNoId && cell(e.right) == kNoId) continue;
        const PointId a = arrangement_.point(group, e.a), b = arrangement_.point(group, e.b);
        if (a < b) sides.push_back({a, b, group.plane, cell(e.left), cell(e.right)});
        else sides.push_back({b, a, group.plane, cell(e.right), cell(e.left)});
      }
    }
    return sides;
  }

  void link_edge(std::span<const EdgeSide> sides) {
    walls_.clear();
    for (const EdgeSide& s : sides) {
      if (s.left != kNoId) walls_.push_back({s.plane, true, s.left});
      if (s.right != kNoId) walls_.push_back({s.plane, false, s.right});
    }
    if (walls_.size() > 2 || (walls_.size() == 2 && sides.size() == 1)) sort_around(sides[0]);
    for (std::size_t k = 0; k < walls_.size(); ++k) {
      const std::uint32_t x = looking(walls_[k], true), y = looking(walls_[(k + 1) % walls_.size()], false);
      join(x, y);
    }
  }
  /// The cell whose free side looks counter-clockwise (or clockwise) around the edge from the wall, or what is covered.
  std::uint32_t looking(const Wall& wall, bool counter_clockwise) const {
    // Counter-clockwise of the left half lies the normal's side, of the right half the other one.
    const int side = wall.left == counter_clockwise ? 1 : -1;
    return facing_[wall.cell] == side ? wall.cell : covered();
  }

  /// Counter-clockwise seen against the way from a to b.
  void sort_around(const EdgeSide& edge) {
    const Approx &a = arrangement_.points.approx(edge.a), &b = arrangement_.points.approx(edge.b);
    const Vec3 d = b.at - a.at;
    axis_ = std::abs(d.x) >= std::abs(d.y) && std::abs(d.x) >= std::abs(d.z) ? 0
            : std::abs(d.y) >= std::abs(d.z)                                 ? 1
                                                                             : 2;
    along_ = 0;
    const double gap = axis_ == 0 ? d.x : axis_ == 1 ? d.y : d.z;
    if (std::abs(gap) > 2 * (a.radius + b.radius) + space_.span() * 0x1p-50) along_ = gap > 0 ? 1 : -1;
    for (int k = 0; k < 3 && along_ == 0; ++k) {
      axis_ = k;
      along_ = space_.exact_order(arrangement_.points.source(edge.a), arrangement_.points.source(edge.b), k);
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

  CellLinks numbered() {
    CellLinks links;
    links.patch.assign(arrangement_.cell_count, kNoId);
    std::vector<std::uint32_t> index(parent_.size(), kNoId);
    for (std::uint32_t c = 0; c < arrangement_.cell_count; ++c) {
      const std::uint32_t r = root(c);
      if (r == root(covered()) || facing_[c] == kNoWall) continue;
      if (index[r] == kNoId) index[r] = links.patches++;
      links.patch[c] = index[r];
    }
    return links;
  }

  const SumSpace& space_;
  const SolidArrangement& arrangement_;
  std::vector<std::uint32_t> parent_;
  static constexpr std::int8_t kNoWall = 2;
  std::vector<std::int8_t> facing_;  // 1 where the free side is the normal's, -1 the other one, 0 none
  std::vector<Wall> walls_;
  int axis_ = 0, along_ = 0;
};

}  // namespace

CellLinks link_cells(const SumSpace& space, const SolidArrangement& arrangement) {
  return Linker(space, arrangement).run();
}

}  // namespace dymsum::spatial
