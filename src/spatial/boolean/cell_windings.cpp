#include "spatial/boolean/cell_windings.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

#include "spatial/boundary/collision.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/vec3.h"
#include "spatial/sum/solid_boundary.h"

namespace dymsum::spatial {
namespace {

/// How often closed surfaces of triangles go around a position.
class WindingNumber {
 public:
  /// For so many positions: a tree of all triangles is made where that pays. Keeps the references.
  WindingNumber(const SumSpace& space, const std::vector<Triangle>& triangles, std::size_t positions);

  /// The triangles above a position that is on none of them: those seen from below their backs less those seen from
  /// below their fronts. Exact. O(log n + k) for k triangles in line with it along z, or O(n).
  int at(const Flag& x) const;

 private:
  int passed(const FlagQuery& query, const Triangle& triangle) const;
  const SumSpace& space_;
  const std::vector<Triangle>& triangles_;
  BoxTree tree_;
};

/// So many queries take less than a tree.
constexpr std::size_t kFewPositions = 16;

Box box_around(const SumSpace& space, const Triangle& triangle) {
  Box box;
  for (const std::uint32_t v : triangle) box.add(space.approx({v, 0}));
  box.grow(space.sum_radius());
  return box;
}

std::vector<Box> boxes_around(const SumSpace& space, const std::vector<Triangle>& triangles) {
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (const Triangle& t : triangles) boxes.push_back(box_around(space, t));
  return boxes;
}

std::int32_t step(const Cell& cell) {
  return static_cast<std::int32_t>(cell.front) - static_cast<std::int32_t>(cell.back);
}

const Cell& cell_of(const SolidArrangement& arrangement, std::uint32_t cell) {
  const PlaneGroup& group = arrangement.groups[arrangement.group_of(cell)];
  return group.cells.cells[cell - group.first_cell];
}

/// The sides of all cells, 2 c below cell c and 2 c + 1 above it, joined where they look into one piece of space: the
/// root of every side.
std::vector<std::uint32_t> joined_sides(const SumSpace& space, const SolidArrangement& arrangement, StageWatch& watch) {
  constexpr std::size_t kPart = 2048;
  const std::size_t edges = arrangement.edge_ends.size();
  std::vector<std::vector<std::array<std::uint32_t, 2>>> joins((edges + kPart - 1) / kPart);
  const auto index = [](CellSide s) { return 2 * s.cell + (s.side > 0 ? 1u : 0u); };
  watch.run(joins.size(), [&](std::size_t part) {
    EdgeWedges wedges(space, arrangement, [](std::uint32_t) { return true; });
    for (std::size_t e = part * kPart; e < std::min(edges, (part + 1) * kPart); ++e)
      wedges.for_each(static_cast<std::uint32_t>(e), [&](CellSide x, CellSide y) {
        joins[part].push_back({index(x), index(y)});
      });
  });
  std::vector<std::uint32_t> parent(2 * std::size_t{arrangement.cell_count});
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t s) {
    while (parent[s] != s) s = parent[s] = parent[parent[s]];
    return s;
  };
  for (const auto& part : joins)
    for (const auto& [x, y] : part) parent[root(x)] = root(y);
  for (std::uint32_t s = 0; s < parent.size(); ++s) parent[s] = root(s);
  return parent;
}

WindingNumber::WindingNumber(const SumSpace& space, const std::vector<Triangle>& triangles, std::size_t positions)
    : space_(space), triangles_(triangles) {
  if (positions > kFewPositions) tree_ = BoxTree(boxes_around(space, triangles));
}

int WindingNumber::at(const Flag& x) const {
  const FlagQuery query(space_, x);
  Box ray = query.box();
  ray.grow(4 * space_.sum_radius());
  ray.high.z = 1e300;
  int winding = 0;
  if (!tree_.empty()) {
    tree_.for_each(ray, [&](std::uint32_t t) { winding += passed(query, triangles_[t]); });
  } else {
    for (const Triangle& t : triangles_)
      if (overlap(box_around(space_, t), ray)) winding += passed(query, t);
  }
  return winding;
}

/// What a triangle adds: 1 or -1 where it is above the position, else 0.
int WindingNumber::passed(const FlagQuery& query, const Triangle& c) const {
  int turn = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t a = c[k], b = c[(k + 1) % 3];
    const PlaneSource upright{{a, 0}, {DirectionSource::Of::p, a, b}, {DirectionSource::Of::axis, 2, 0}, false};
    int s = query.side(upright, space_.p()[b] - space_.p()[a], {0, 0, 1});
    // The sign is that of the position moved by an infinitesimal along x, and a smaller one along y.
    for (int axis = 0; axis < 2 && s == 0; ++axis) s = space_.exact_normal(upright, axis);
    if (s == 0 || (k > 0 && s != turn)) return 0;
    turn = s;
  }
  const PlaneSource plane{{c[0], 0}, {DirectionSource::Of::p, c[0], c[1]}, {DirectionSource::Of::p, c[0], c[2]}, false};
  const int up = space_.exact_normal(plane, 2);
  const Vec3 &a = space_.p()[c[0]], &b = space_.p()[c[1]], &d = space_.p()[c[2]];
  return query.side(plane, b - a, d - a) * up < 0 ? up : 0;
}

}  // namespace

std::optional<std::uint32_t> open_edge(const SolidArrangement& arrangement) {
  for (std::uint32_t edge = 0; edge < arrangement.edge_ends.size(); ++edge) {
    std::int64_t around = 0;
    for (const EdgeUse use : arrangement.uses(edge)) {
      const PlaneGroup& group = arrangement.groups[use.group];
      const CellEdge& e = group.cells.edges[use.edge];
      const bool up = arrangement.point(group, e.a) < arrangement.point(group, e.b);
      // Counter-clockwise around the edge, the left half is passed from below to above, the right one from above.
      if (e.left != kNoId) around += (up ? -1 : 1) * step(group.cells.cells[e.left]);
      if (e.right != kNoId) around += (up ? 1 : -1) * step(group.cells.cells[e.right]);
    }
    if (around != 0) return edge;
  }
  return std::nullopt;
}

CellWindings cell_windings(const SumSpace& space, const SolidArrangement& arrangement,
                           const std::vector<Triangle>& triangles, StageWatch& watch) {
  const std::vector<std::uint32_t> volume = joined_sides(space, arrangement, watch);
  const std::uint32_t cells = arrangement.cell_count;
  std::vector<std::int32_t> steps;
  steps.reserve(cells);
  for (const PlaneGroup& group : arrangement.groups)
    for (const Cell& cell : group.cells.cells) steps.push_back(step(cell));

  // The cells around every piece of space, as runs of a list.
  std::vector<std::uint32_t> first(volume.size() + 1), around(volume.size());
  for (const std::uint32_t v : volume) ++first[v + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t s = 0; s < volume.size(); ++s) around[next[volume[s]]++] = s;

  // Winding numbers relative to that of the first piece of every component.
  CellWindings result;
  std::vector<std::int32_t> relative(volume.size());
  std::vector<std::uint32_t> component(volume.size(), kNoId), starts, queue;
  for (std::uint32_t start = 0; start < volume.size(); ++start) {
    if (volume[start] != start || component[start] != kNoId) continue;
    const auto name = static_cast<std::uint32_t>(starts.size());
    starts.push_back(around[first[start]]);
    component[start] = name;
    queue.assign(1, start);
    for (std::size_t k = 0; k < queue.size(); ++k) {
      const std::uint32_t here = queue[k];
      for (std::uint32_t i = first[here]; i < first[here + 1]; ++i) {
        const std::uint32_t side = around[i], there = volume[side ^ 1];
        const std::int32_t value = relative[here] + ((side & 1) != 0 ? 1 : -1) * steps[side / 2];
        if (component[there] == kNoId) {
          component[there] = name, relative[there] = value;
          queue.push_back(there);
        } else if (relative[there] != value) {
          throw std::logic_error("winding numbers of a surface that is not closed");
        }
      }
    }
    result.volumes += queue.size();
  }
  result.components = starts.size();

  // One position for every component: sheets, which have none, come last, and lie beside other cells.
  const WindingNumber winding(space, triangles, starts.size());
  std::vector<std::int32_t> offset(starts.size());
  watch.run(starts.size(), [&](std::size_t k) {
    const PlaneGroup& group = arrangement.groups[arrangement.group_of(starts[k] / 2)];
    const Cell& cell = cell_of(arrangement, starts[k] / 2);
    const int side = (starts[k] & 1) != 0 ? 1 : -1;
    offset[k] = winding.at(flag_at(arrangement, group, cell, side)) - relative[volume[starts[k]]];
  });
  result.above.reserve(cells);
  for (std::uint32_t c = 0; c < cells; ++c) {
    const std::uint32_t v = volume[2 * std::size_t{c} + 1];
    result.above.push_back(relative[v] + offset[component[v]]);
  }
  return result;
}

}  // namespace dymsum::spatial
