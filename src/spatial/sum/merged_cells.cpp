#include "spatial/sum/merged_cells.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/memory_budget.h"
#include "base/parallel.h"

namespace dymsum::spatial {
namespace {

/// Pieces of lines that neighbouring cells of one plane share and that nothing else selected touches are no face edges.
class Merger {
 public:
  Merger(const SumSpace& space, const SolidArrangement& arrangement, const Selection& selection,
         std::span<const PointId> corners, StageWatch& watch)
      : space_(space),
        arrangement_(arrangement),
        selection_(selection),
        corners_(corners),
        watch_(watch),
        parts_((arrangement.groups.size() + kPart - 1) / kPart) {}

  std::vector<CellPolygon> run() {
    count_walls();
    in_parts([&](Part& part, const PlaneGroup& group) { trace(group, part); });
    collect(polygons_, &Part::polygons), collect(face_edges_, &Part::face_edges);
    find_corners();
    watch_.run_intervals(polygons_.size(), kPart, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k)
        for (std::vector<PointId>& loop : polygons_[k].loops)
          std::erase_if(loop, [&](PointId p) { return corner_[p] == 0; });
    });
    return std::move(polygons_);
  }

 private:
  struct FaceEdge {
    PointId a, b;
    PlaneId plane, cut;
  };
  /// What an interval of groups gives.
  struct Part {
    std::vector<CellPolygon> polygons;
    std::vector<FaceEdge> face_edges;
    struct Scratch {
      std::vector<std::uint32_t> next, cell_of, parent, polygon_of;  // per half-edge; per cell
      std::vector<std::uint8_t> inner, seen;                         // per edge; per half-edge
    } scratch;
  };
  static constexpr std::size_t kPart = 64;

  template <class F>
  void in_parts(F f) {
    watch_.run_intervals(arrangement_.groups.size(), kPart, [&](std::size_t k, std::size_t first, std::size_t last) {
      for (std::size_t g = first; g < last; ++g)
        if (is_selected(arrangement_.groups[g])) f(parts_[k], arrangement_.groups[g]);
      parts_[k].scratch = {};
    });
  }
  template <class T>
  void collect(std::vector<T>& all, std::vector<T> Part::*some) {
    for (Part& part : parts_) {
      std::move((part.*some).begin(), (part.*some).end(), std::back_inserter(all));
      base::free_memory(part.*some);
    }
  }
  bool is_selected(const PlaneGroup& group) const {
    const auto first = selection_.side.begin() + group.first_cell;
    return std::any_of(first, first + static_cast<std::ptrdiff_t>(group.cells.cells.size()),
                       [](std::int8_t side) { return side != 0; });
  }

  int side(const PlaneGroup& group, std::uint32_t cell) const {
    return cell == kNoId ? 0 : selection_.side[group.first_cell + cell];
  }

  /// How many selected cells come to every piece, up to three.
  void count_walls() {
    first_edge_.push_back(0);
    for (const PlaneGroup& group : arrangement_.groups)
      first_edge_.push_back(first_edge_.back() + static_cast<std::uint32_t>(group.cells.edges.size()));
    edge_of_.resize(first_edge_.back()), walls_.resize(arrangement_.edge_ends.size());
    watch_.run_intervals(walls_.size(), 1024, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t e = first; e < last; ++e) count_walls(static_cast<std::uint32_t>(e));
    });
  }
  void count_walls(std::uint32_t edge) {
    int walls = 0;
    for (const EdgeUse use : arrangement_.uses(edge)) {
      edge_of_[first_edge_[use.group] + use.edge] = edge;
      const PlaneGroup& group = arrangement_.groups[use.group];
      const CellEdge& e = group.cells.edges[use.edge];
      walls += (side(group, e.left) != 0) + (side(group, e.right) != 0);
    }
    walls_[edge] = static_cast<std::uint8_t>(std::min(walls, 3));
  }
  bool merged(const PlaneGroup& group, std::uint32_t e) const {
    const CellEdge& edge = group.cells.edges[e];
    const int left = side(group, edge.left);
    if (left == 0 || left != side(group, edge.right)) return false;
    return walls_[edge_of_[first_edge_[&group - arrangement_.groups.data()] + e]] == 2;
  }

  void trace(const PlaneGroup& group, Part& part) const {
    const PlaneCells& cells = group.cells;
    auto& [next, cell_of, parent, polygon_of, inner, seen] = part.scratch;
    next.assign(2 * cells.edges.size(), kNoId), cell_of.assign(next.size(), kNoId), parent.resize(cells.cells.size());
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
    const auto root = [&parent = parent](std::uint32_t c) {
      while (parent[c] != c) c = parent[c] = parent[parent[c]];
      return c;
    };
    inner.resize(cells.edges.size()), seen.assign(next.size(), 0);
    for (std::uint32_t e = 0; e < cells.edges.size(); ++e) {
      inner[e] = merged(group, e);
      if (inner[e]) parent[root(cells.edges[e].left)] = root(cells.edges[e].right);
    }
    std::vector<CellPolygon>& polygons = part.polygons;
    polygon_of.assign(cells.cells.size(), kNoId);
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
        part.face_edges.push_back({loop.back(), arrangement_.point(group, g & 1 ? e.a : e.b), group.plane, e.cut});
        g = next[g];
        while (inner[g / 2]) g = next[g ^ 1];
      }
      if (side(group, cell_of[h]) < 0) std::reverse(loop.begin(), loop.end());
      polygons[polygon].loops.push_back(std::move(loop));
    }
  }

  /// A point is no corner where all face edges run along one line.
  void find_corners() {
    if (face_edges_.empty()) return;
    corner_.assign(arrangement_.points.size(), 0);
    for (const PointId p : corners_) corner_[p] = 1;
    std::vector<std::uint32_t> first(arrangement_.points.size(), kNoId);
    for (std::uint32_t k = 0; k < face_edges_.size(); ++k)
      for (const PointId at : {face_edges_[k].a, face_edges_[k].b})
        if (first[at] == kNoId) first[at] = k;
    watch_.run_intervals(face_edges_.size(), 1024, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        for (const PointId at : {face_edges_[k].a, face_edges_[k].b}) {
          if (base::shared_byte(corner_[at]) == 0 && !on_line(face_edges_[first[at]], face_edges_[k], at))
            base::set_shared_byte(corner_[at], 1);
        }
      }
    });
  }
  /// Whether two face edges with an end in common run along one line.
  bool on_line(const FaceEdge& x, const FaceEdge& y, PointId common) const {
    if (x.plane == y.plane && x.cut == y.cut) return true;
    const PointId end = y.a == common ? y.b : y.a;
    const PointSource& s = arrangement_.points.source(end);
    const Approx& a = arrangement_.points.approx(end);
    return space_.side(x.plane, s, a) == 0 && space_.side(x.cut, s, a) == 0;
  }

  const SumSpace& space_;
  const SolidArrangement& arrangement_;
  const Selection& selection_;
  std::span<const PointId> corners_;
  StageWatch& watch_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> first_edge_, edge_of_;  // per group; of its edges: which one of the arrangement each is
  std::vector<std::uint8_t> walls_;                  // per edge of the arrangement
  std::vector<CellPolygon> polygons_;
  std::vector<FaceEdge> face_edges_;
  std::vector<std::uint8_t> corner_;  // per point
};

}  // namespace

std::vector<CellPolygon> merged_cells(const SumSpace& space, const SolidArrangement& arrangement,
                                      const Selection& selection, std::span<const PointId> corners, StageWatch& watch) {
  return Merger(space, arrangement, selection, corners, watch).run();
}

}  // namespace dymsum::spatial
