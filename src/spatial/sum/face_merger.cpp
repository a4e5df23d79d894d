#include "spatial/sum/face_merger.h"

#include <algorithm>
#include <numeric>

namespace dymsum::spatial {

namespace {

/// Pieces of lines that neighbouring cells of one plane share and that nothing else selected touches are no borders.
class Merger {
 public:
  Merger(const SumSpace& space, const SolidArrangement& arrangement, const Selection& selection)
      : space_(space), arrangement_(arrangement), selection_(selection) {}

  std::vector<CellPolygon> run() {
    count_walls();
    std::vector<CellPolygon> polygons;
    for (const PlaneGroup& group : arrangement_.groups) trace(group, polygons);
    return polygons;
  }
  const std::vector<bool>& corners() {
    if (corner_.empty()) find_corners();
    return corner_;
  }

 private:
  static std::uint64_t key(PointId a, PointId b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
  }
  std::uint64_t key(const PlaneGroup& group, std::uint32_t edge) const {
    const CellEdge& e = group.cells.edges[edge];
    return key(arrangement_.point(group, e.a), arrangement_.point(group, e.b));
  }
  int side(const PlaneGroup& group, std::uint32_t cell) const {
    return cell == kNoId ? 0 : selection_.side[group.first_cell + cell];
  }

  /// How many selected cells come to every piece.
  void count_walls() {
    for (const PlaneGroup& group : arrangement_.groups) {
      for (std::uint32_t e = 0; e < group.cells.edges.size(); ++e) {
        const CellEdge& edge = group.cells.edges[e];
        for (const std::uint32_t cell : {edge.left, edge.right})
          if (side(group, cell) != 0) walls_.push_back(key(group, e));
      }
    }
    std::sort(walls_.begin(), walls_.end());
  }
  bool merged(const PlaneGroup& group, std::uint32_t e) const {
    const CellEdge& edge = group.cells.edges[e];
    const int left = side(group, edge.left);
    if (left == 0 || left != side(group, edge.right)) return false;
    const auto [first, last] = std::equal_range(walls_.begin(), walls_.end(), key(group, e));
    return last - first == 2;
  }

  void trace(const PlaneGroup& group, std::vector<CellPolygon>& polygons) {
    const PlaneCells& cells = group.cells;
    const bool any = std::any_of(cells.cells.begin(), cells.cells.end(),
                                 [&, c = group.first_cell](const Cell&) mutable { return selection_.side[c++] != 0; });
    if (!any) return;
    std::vector<std::uint32_t> next(2 * cells.edges.size(), kNoId), cell_of(next.size(), kNoId),
        parent(cells.cells.size());
    for (std::uint32_t c = 0; c < cells.cells.size(); ++c) {
      for (std::uint32_t l = cells.cells[c].first_loop; l < cells.cells[c].last_loop; ++l) {
        const std::uint32_t begin = cells.loops[l], end = cells.loops[l + 1];
        for (std::uint32_t k = begin; k < end; ++k) {
          next[cells.half_edges[k]] = cells.half_edges[k + 1 < end ? k + 1 : begin];
          cell_of[cells.half_edges[k]] = c;
        }
      }
    }
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t c) {
      while (parent[c] != c) c = parent[c] = parent[parent[c]];
      return c;
    };
    std::vector<bool> inner(cells.edges.size());
    for (std::uint32_t e = 0; e < cells.edges.size(); ++e) {
      inner[e] = merged(group, e);
      if (inner[e]) parent[root(cells.edges[e].left)] = root(cells.edges[e].right);
    }
    std::vector<std::uint32_t> polygon_of(cells.cells.size(), kNoId);
    std::vector<bool> seen(next.size());
    for (std::uint32_t h = 0; h < next.size(); ++h) {
      if (seen[h] || cell_of[h] == kNoId || side(group, cell_of[h]) == 0 || inner[h / 2]) continue;
      std::uint32_t& polygon = polygon_of[root(cell_of[h])];
      if (polygon == kNoId) {
        polygon = static_cast<std::uint32_t>(polygons.size());
        polygons.push_back({{}, group.first_cell + cell_of[h]});
      }
      std::vector<PointId> loop;
      for (std::uint32_t g = h; !seen[g];) {
        seen[g] = true;
        const CellEdge& e = cells.edges[g / 2];
        loop.push_back(arrangement_.point(group, g & 1 ? e.b : e.a));
        borders_.push_back({loop.back(), arrangement_.point(group, g & 1 ? e.a : e.b), group.plane, e.cut});
        g = next[g];
        while (inner[g / 2]) g = next[g ^ 1];
      }
      if (side(group, cell_of[h]) < 0) std::reverse(loop.begin(), loop.end());
      polygons[polygon].loops.push_back(std::move(loop));
    }
  }

  struct Border {
    PointId a, b;
    PlaneId plane, cut;
  };

  /// A point is no corner where all borders run along one line.
  void find_corners() {
    corner_.assign(arrangement_.points.size(), false);
    std::vector<std::uint32_t> first(arrangement_.points.size(), kNoId);
    for (std::uint32_t k = 0; k < borders_.size(); ++k) {
      for (const PointId at : {borders_[k].a, borders_[k].b}) {
        if (corner_[at]) continue;
        if (first[at] == kNoId) first[at] = k;
        else if (!on_line(borders_[first[at]], borders_[k])) corner_[at] = true;
      }
    }
  }
  bool on_line(const Border& x, const Border& y) const {
    const auto on = [&](PointId p) {
      const PointSource& s = arrangement_.points.source(p);
      const Approx& a = arrangement_.points.approx(p);
      return space_.side(x.plane, s, a) == 0 && space_.side(x.cut, s, a) == 0;
    };
    return on(y.a) && on(y.b);
  }

  const SumSpace& space_;
  const SolidArrangement& arrangement_;
  const Selection& selection_;
  std::vector<std::uint64_t> walls_;
  std::vector<Border> borders_;
  std::vector<bool> corner_;
};

}  // namespace

std::vector<CellPolygon> merged_cells(const SumSpace& space, const SolidArrangement& arrangement,
                                      const Selection& selection) {
  Merger merger(space, arrangement, selection);
  std::vector<CellPolygon> result = merger.run();
  const std::vector<bool>& corner = merger.corners();
  for (CellPolygon& polygon : result)
    for (std::vector<PointId>& loop : polygon.loops) std::erase_if(loop, [&](PointId p) { return !corner[p]; });
  return result;
}

}  // namespace dymsum::spatial
